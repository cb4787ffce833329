#include "core/surface.h"

#include "core/simd.h"

namespace candil {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Triangle& t, Vec3 weights) {
  return weights.x * values[t.x] + weights.y * values[t.y] + weights.z * values[t.z];
}

Float4 interpolate(const Vec3& a, const Vec3& b, const Vec3& c, Vec3 weights) {
  return weights.x * to_lanes(a) + weights.y * to_lanes(b) + weights.z * to_lanes(c);
}

Float4 normalize_or(Float4 v, Float4 otherwise) {
  const float squared = dot(v, v);
  return squared > 0 && squared < infinity ? v * (1 / glm::sqrt(squared)) : otherwise;
}

/// A position and its normals with what is needed to tell the error of the position.
struct Place {
  Float4 position, normal_geometric, normal;
  Float4 magnitude;  // of each coordinate that took part, or more
};

/// Carries a place of an object to the world. Normals go like M^-T up to a positive factor (see normal_matrix()).
Place to_world(const Affine& transform, const Place& place) {
  const Float4x3 m(transform.linear);
  const Float4 yz = cross(m.y, m.z), translation = to_lanes(transform.translation);
  const float side = dot(m.x, yz) < 0 ? -1.0f : 1.0f;
  const Float4x3 normals(side * yz, side * cross(m.z, m.x), side * cross(m.x, m.y));
  const Float4 row_sums = absolute(m.x) + absolute(m.y) + absolute(m.z);
  return {m * place.position + translation, normals * place.normal_geometric, normals * place.normal,
          row_sums * max_component(place.magnitude) + absolute(translation)};
}

Vec4 interpolate_tangent(const Mesh& mesh, const Triangle& triangle, Vec3 weights, const Instance& instance) {
  const Vec4 tangent = interpolate(mesh.tangents, triangle, weights);
  const Mat3& m = instance.to_world.linear;
  const bool is_mirrored = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
  const Float4 direction = Float4x3(m) * to_lanes(Vec3(tangent));
  return Vec4(to_vec3(normalize_or(direction, Float4{})), is_mirrored ? -tangent.w : tangent.w);
}

}  // namespace

SurfacePoint make_surface_point(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Instance& instance = scene.instances[hit.instance];
  const Triangle triangle = mesh.triangles[hit.triangle];
  const Vec3 weights(1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x, hit.barycentric.y);
  const Float4 a = to_lanes(mesh.positions[triangle.x]), b = to_lanes(mesh.positions[triangle.y]),
               c = to_lanes(mesh.positions[triangle.z]);
  Place place;
  place.position = weights.x * a + weights.y * b + weights.z * c;
  place.normal_geometric = cross(b - a, c - a);
  place.normal = place.normal_geometric;
  if (!mesh.normals.empty()) {
    place.normal = interpolate(mesh.normals[triangle.x], mesh.normals[triangle.y], mesh.normals[triangle.z], weights);
  }
  place.magnitude = maximum(absolute(a), maximum(absolute(b), absolute(c)));
  if (!instance.is_world_space) place = to_world(instance.to_world, place);

  SurfacePoint point;
  point.instance = hit.instance;
  point.mesh = hit.mesh;
  point.triangle = hit.triangle;
  point.material = mesh.material;
  point.position = to_vec3(place.position);
  const Float4 normal_geometric = normalize_or(place.normal_geometric, Float4{0, 1, 0, 0});
  const Float4 normal = normalize_or(place.normal, normal_geometric);
  point.normal_geometric = to_vec3(normal_geometric);
  // The winding decides which side is the front (glTF 2.0, section 3.7.4); a normal that disagrees is turned round.
  point.normal = to_vec3(dot(normal, normal_geometric) < 0 ? -normal : normal);
  point.offset = surface_offset(max_component(place.magnitude));
  if (!mesh.tangents.empty()) point.tangent = interpolate_tangent(mesh, triangle, weights, instance);
  const bool is_textured = scene.materials[mesh.material].is_textured();
  for (int set = 0; set < 2; ++set) {
    if (is_textured && !mesh.uvs[set].empty()) point.uv[set] = interpolate(mesh.uvs[set], triangle, weights);
  }
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, triangle, weights);
  return point;
}

}  // namespace candil

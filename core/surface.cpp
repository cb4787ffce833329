#include "core/surface.h"

#include "core/shape.h"
#include "core/simd.h"

namespace candil {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Triangle& t, Vec3 weights) {
  return weights.x * values[t.x] + weights.y * values[t.y] + weights.z * values[t.z];
}

Vec3 vertex_weights(const Hit& hit) {
  return {1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x, hit.barycentric.y};
}

Float4 interpolate(const Float4 (&values)[3], Vec3 weights) {
  return weights.x * values[0] + weights.y * values[1] + weights.z * values[2];
}

Float4 normalize_or(Float4 v, Float4 otherwise) {
  const float squared = dot(v, v);
  return squared > 0 && squared < infinity ? v * (1 / glm::sqrt(squared)) : otherwise;
}

/// A position and its normals with what is needed to tell the error of the position.
struct Place {
  Float4 position, normal_geometric, normal;
  Float4 lift{};     // from the triangle to the surface that the normals stand for
  Float4 magnitude;  // of each coordinate that took part, or more
  bool is_smooth = false;
};

/// Carries a place of an object to the world. Normals go like M^-T up to a positive factor (see normal_matrix()).
void carry_to_world(const Affine& transform, Place& place) {
  const Float4x3 m(transform.linear);
  const Float4 yz = cross(m.y, m.z), translation = to_lanes(transform.translation);
  const float side = dot(m.x, yz) < 0 ? -1.0f : 1.0f;
  const Float4x3 normals(side * yz, side * cross(m.z, m.x), side * cross(m.x, m.y));
  const Float4 row_sums = absolute(m.x) + absolute(m.y) + absolute(m.z);
  place.position = m * place.position + translation;
  place.normal_geometric = normals * place.normal_geometric;
  place.normal = normals * place.normal;
  place.lift = m * place.lift;
  place.magnitude = row_sums * max_component(place.magnitude) + absolute(translation);
}

struct Corners {
  Float4 positions[3], normals[3];
};

/// Whether the normals of the vertices, unit vectors, are at most 53 degrees off the triangle's.
bool is_smooth_surface(const Corners& corners, Float4 normal_geometric) {
  constexpr float least_cosine_squared = 0.36f;
  const float least = least_cosine_squared * dot(normal_geometric, normal_geometric);
  for (const Float4 normal : corners.normals) {
    const float cosine = dot(normal, normal_geometric);  // times the length that is squared in `least`
    if (!(cosine > 0 && cosine * cosine >= least)) return false;
  }
  return true;
}

/// From a point of a triangle towards the interpolation of its images on the tangent planes of the vertices (Hanika
/// 2021), but half the way: a surface of second order is exactly in the middle between its chord and these planes.
Float4 lift_to_smooth_surface(Float4 position, const Corners& corners, Vec3 weights) {
  Float4 lift{};
  for (int i = 0; i < 3; ++i) {
    lift -= (0.5f * weights[i] * dot(position - corners.positions[i], corners.normals[i])) * corners.normals[i];
  }
  return lift;
}

Vec4 interpolate_tangent(const Mesh& mesh, const Triangle& triangle, Vec3 weights, const Instance& instance) {
  const Vec4 tangent = interpolate(mesh.tangents, triangle, weights);
  const Mat3& m = instance.to_world.linear;
  const bool is_mirrored = glm::dot(m[0], glm::cross(m[1], m[2])) < 0;
  const Float4 direction = Float4x3(m) * to_lanes(Vec3(tangent));
  return Vec4(to_vec3(normalize_or(direction, Float4{})), is_mirrored ? -tangent.w : tangent.w);
}

SurfacePoint triangle_surface_point(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Instance& instance = scene.instances[hit.instance];
  const Triangle triangle = mesh.triangles[hit.triangle];
  const Vec3 weights = vertex_weights(hit);
  const Material& material = scene.materials[mesh.material];
  Corners corners;
  for (int i = 0; i < 3; ++i) corners.positions[i] = to_lanes(mesh.positions[triangle[i]]);
  const auto& [a, b, c] = corners.positions;
  Place place;
  place.position = interpolate(corners.positions, weights);
  place.normal_geometric = cross(b - a, c - a);
  place.normal = place.normal_geometric;
  if (!mesh.normals.empty()) {
    for (int i = 0; i < 3; ++i) corners.normals[i] = to_lanes(mesh.normals[triangle[i]]);
    place.normal = interpolate(corners.normals, weights);
    place.is_smooth = !material.is_transmissive() && is_smooth_surface(corners, place.normal_geometric);
    if (place.is_smooth) place.lift = lift_to_smooth_surface(place.position, corners, weights);
  }
  place.magnitude = maximum(absolute(a), maximum(absolute(b), absolute(c)));
  if (!instance.is_world_space) carry_to_world(instance.to_world, place);

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
  point.is_smooth = place.is_smooth;
  point.bulge = dot(place.lift, normal_geometric);
  point.offset = surface_offset(max_component(place.magnitude));
  if (!mesh.tangents.empty()) point.tangent = interpolate_tangent(mesh, triangle, weights, instance);
  const bool is_textured = material.is_textured();
  for (int set = 0; set < 2; ++set) {
    if (is_textured && !mesh.uvs[set].empty()) point.uv[set] = interpolate(mesh.uvs[set], triangle, weights);
  }
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, triangle, weights);
  return point;
}

}  // namespace

// One call for each kind and nothing else: a function that returns now one object, now another, builds and copies it.
SurfacePoint make_surface_point(const Scene& scene, const Hit& hit) {
  return hit.is_shape() ? shape_surface_point(scene, hit.triangle, hit.barycentric)
                        : triangle_surface_point(scene, hit);
}

Vec2 first_texture_coordinates(const Scene& scene, const Hit& hit) {
  if (hit.is_shape()) return shape_texture_coordinates(scene.shapes[hit.triangle], hit.barycentric);
  const Mesh& mesh = scene.meshes[hit.mesh];
  if (mesh.uvs[0].empty()) return Vec2(0);
  return interpolate(mesh.uvs[0], mesh.triangles[hit.triangle], vertex_weights(hit));
}

}  // namespace candil

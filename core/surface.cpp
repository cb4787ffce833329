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

/// 1 / length; 0 where that or its square is not finite.
float inverse_length(Float4 v) {
  const float squared = dot(v, v);
  return squared > 0 && squared < infinity ? 1 / glm::sqrt(squared) : 0;
}

Float4 normalize_or(Float4 v, Float4 otherwise) {
  const float factor = inverse_length(v);
  return factor > 0 ? v * factor : otherwise;
}

/// A position and its normals with what is needed to tell the error of the position.
struct Place {
  Float4 position, normal_geometric, normal;
  Float4 magnitude;  // of each coordinate that took part, or more
  float bulge = 0;   // of the surface that the normals stand for, times the length of normal_geometric
  bool is_smooth = false;
};

/// Carries a place of an object to the world. Normals go like M^-T up to a positive factor (see normal_matrix()).
void carry_to_world(const Affine& transform, Place& place) {
  const Float4x3 m(transform.linear);
  const Float4 yz = cross(m.y, m.z), translation = to_lanes(transform.translation);
  const float determinant = dot(m.x, yz), side = determinant < 0 ? -1.0f : 1.0f;
  const Float4x3 normals(side * yz, side * cross(m.z, m.x), side * cross(m.x, m.y));
  const Float4 row_sums = absolute(m.x) + absolute(m.y) + absolute(m.z);
  place.position = m * place.position + translation;
  place.normal_geometric = normals * place.normal_geometric;
  place.normal = normals * place.normal;
  place.bulge *= side * determinant;  // (M lift) . (M^-T normal |det|)
  place.magnitude = row_sums * max_component(place.magnitude) + absolute(translation);
}

struct Corners {
  Float4 positions[3], normals[3];
};

/// Decides whether the normals stand for a smooth surface: if all of them, unit vectors, are at most 53 degrees off the
/// triangle's. Its bulge goes from a point of the triangle towards the interpolation of its images on the tangent
/// planes of the vertices (Hanika 2021), but half the way: a surface of second order is exactly in the middle between
/// its chord and these planes.
void find_bulge(const Corners& corners, Vec3 weights, Place& place) {
  constexpr float least_cosine_squared = 0.36f;
  // One corner in each lane.
  const Float4x3 positions = from_rows(corners.positions[0], corners.positions[1], corners.positions[2]);
  const Float4x3 normals = from_rows(corners.normals[0], corners.normals[1], corners.normals[2]);
  const Float4 cosines = normals * place.normal_geometric;  // times the length that is squared in `least`
  const float least = least_cosine_squared * dot(place.normal_geometric, place.normal_geometric);
  if (!(min_component(cosines * absolute(cosines)) > least)) return;
  place.is_smooth = true;
  const Float4 heights = (place.position[0] - positions.x) * normals.x + (place.position[1] - positions.y) * normals.y +
                         (place.position[2] - positions.z) * normals.z;
  place.bulge = -0.5f * dot(heights * cosines, to_lanes(weights));
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
    if (!material.is_transmissive()) find_bulge(corners, weights, place);
  }
  place.magnitude = maximum(absolute(a), maximum(absolute(b), absolute(c)));
  if (!instance.is_world_space) carry_to_world(instance.to_world, place);

  SurfacePoint point;
  point.instance = hit.instance;
  point.mesh = hit.mesh;
  point.triangle = hit.triangle;
  point.material = mesh.material;
  point.position = to_vec3(place.position);
  const float per_length = inverse_length(place.normal_geometric);
  const Float4 normal_geometric = per_length > 0 ? place.normal_geometric * per_length : Float4{0, 1, 0, 0};
  const Float4 normal = normalize_or(place.normal, normal_geometric);
  point.normal_geometric = to_vec3(normal_geometric);
  // The winding decides which side is the front (glTF 2.0, section 3.7.4); a normal that disagrees is turned round.
  point.normal = to_vec3(dot(normal, normal_geometric) < 0 ? -normal : normal);
  point.is_smooth = place.is_smooth;
  point.bulge = per_length > 0 ? place.bulge * per_length : 0;
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

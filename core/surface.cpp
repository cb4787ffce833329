#include "core/surface.h"

namespace candil {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const Triangle& t, Vec3 weights) {
  return weights.x * values[t.x] + weights.y * values[t.y] + weights.z * values[t.z];
}

Vec3 normalize_or(Vec3 v, Vec3 otherwise) {
  const float squared = length_squared(v);
  return squared > 0 && squared < infinity ? v * (1 / glm::sqrt(squared)) : otherwise;
}

float largest_coordinate(Vec3 a, Vec3 b, Vec3 c) {
  return max_component(glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
}

}  // namespace

SurfacePoint make_surface_point(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Instance& instance = scene.instances[hit.instance];
  const Triangle triangle = mesh.triangles[hit.triangle];
  const Vec3 weights(1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric.x, hit.barycentric.y);
  const Vec3 a = mesh.positions[triangle.x], b = mesh.positions[triangle.y], c = mesh.positions[triangle.z];

  SurfacePoint point;
  point.instance = hit.instance;
  point.mesh = hit.mesh;
  point.triangle = hit.triangle;
  point.material = mesh.material;
  point.position = weights.x * a + weights.y * b + weights.z * c;
  Vec3 normal_geometric = glm::cross(b - a, c - a);
  Vec3 normal = mesh.normals.empty() ? normal_geometric : interpolate(mesh.normals, triangle, weights);
  float magnitude = largest_coordinate(a, b, c);
  if (!mesh.tangents.empty()) point.tangent = interpolate(mesh.tangents, triangle, weights);

  if (!instance.is_world_space) {
    const Affine& transform = instance.to_world;
    const Mat3 normals = normal_matrix(transform.linear);
    normal_geometric = normals * normal_geometric;
    normal = normals * normal;
    point.position = transform.point(point.position);
    const Mat3& m = transform.linear;
    magnitude = magnitude * max_component(glm::abs(m[0]) + glm::abs(m[1]) + glm::abs(m[2])) +
                max_component(glm::abs(transform.translation));
    if (!mesh.tangents.empty()) {
      const float mirrored = glm::dot(m[0], glm::cross(m[1], m[2])) < 0 ? -1.0f : 1.0f;
      point.tangent = Vec4(m * Vec3(point.tangent), point.tangent.w * mirrored);
    }
  }
  if (!mesh.tangents.empty()) point.tangent = Vec4(normalize_or(Vec3(point.tangent), Vec3(0)), point.tangent.w);
  point.normal_geometric = normalize_or(normal_geometric, Vec3(0, 1, 0));
  point.normal = normalize_or(normal, point.normal_geometric);
  // The winding decides which side is the front (glTF 2.0, section 3.7.4); a normal that disagrees is turned round.
  if (glm::dot(point.normal, point.normal_geometric) < 0) point.normal = -point.normal;
  point.offset = surface_offset(magnitude);

  for (int set = 0; set < 2; ++set) {
    if (!mesh.uvs[set].empty()) point.uv[set] = interpolate(mesh.uvs[set], triangle, weights);
  }
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, triangle, weights);
  return point;
}

}  // namespace candil

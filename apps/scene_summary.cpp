#include "apps/scene_summary.h"

#include <algorithm>

namespace candil {
namespace {

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t geometry_bytes(const Mesh& mesh) {
  return bytes_of(mesh.positions) + bytes_of(mesh.triangles) + bytes_of(mesh.normals) + bytes_of(mesh.tangents) +
         bytes_of(mesh.uvs[0]) + bytes_of(mesh.uvs[1]) + bytes_of(mesh.colors);
}

std::size_t emissive_triangles(const Scene& scene, const Object& object) {
  std::size_t count = 0;
  for (std::uint32_t i = object.first_mesh; i < object.first_mesh + object.mesh_count; ++i) {
    const Mesh& mesh = scene.meshes[i];
    if (!is_black(scene.materials[mesh.material].emission)) count += mesh.triangles.size();
  }
  return count;
}

std::size_t count_lights(const Scene& scene, PunctualKind kind) {
  return static_cast<std::size_t>(std::ranges::count(scene.punctual_lights, kind, &PunctualLight::kind));
}

std::size_t count_shapes(const Scene& scene, ShapeKind kind) {
  return static_cast<std::size_t>(std::ranges::count(scene.shapes, kind, &Shape::kind));
}

}  // namespace

double SceneSummary::bytes_per_triangle() const {
  return triangles == 0 ? 0 : static_cast<double>(geometry_bytes) / static_cast<double>(triangles);
}

SceneSummary summarize(const Scene& scene) {
  SceneSummary summary;
  summary.meshes = scene.meshes.size();
  summary.objects = scene.objects.size();
  summary.instances = scene.instances.size();
  summary.materials = scene.materials.size();
  summary.spheres = count_shapes(scene, ShapeKind::sphere);
  summary.discs = count_shapes(scene, ShapeKind::disc);
  summary.planes = count_shapes(scene, ShapeKind::plane);
  summary.emissive_shapes = static_cast<std::size_t>(std::ranges::count_if(
      scene.shapes, [&](const Shape& shape) { return !is_black(scene.materials[shape.material].emission); }));
  for (const Mesh& mesh : scene.meshes) {
    summary.triangles += mesh.triangles.size();
    summary.vertices += mesh.positions.size();
    summary.geometry_bytes += geometry_bytes(mesh);
  }
  summary.instanced_triangles = instanced_triangle_count(scene);
  for (const TextureImage& image : scene.images) summary.texture_bytes += image.bytes();
  for (const Instance& instance : scene.instances)
    summary.emissive_triangles += emissive_triangles(scene, scene.objects[instance.object]);
  summary.point_lights = count_lights(scene, PunctualKind::point);
  summary.spot_lights = count_lights(scene, PunctualKind::spot);
  summary.directional_lights = count_lights(scene, PunctualKind::directional);
  summary.has_environment = scene.environment.is_present();
  summary.bounds = scene_bounds(scene);
  return summary;
}

}  // namespace candil

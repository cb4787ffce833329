#include "core/bvh/scene_parts.h"

#include <cmath>
#include <stdexcept>

#include "core/bvh/box_test.h"
#include "core/shape.h"

namespace candil {
namespace {

void append_parts(const Scene& scene, HitFilter filter, const Object& object, std::uint32_t instance,
                  std::vector<MeshPart>& parts) {
  for (std::uint32_t i = 0; i < object.mesh_count; ++i) {
    const std::uint32_t id = object.first_mesh + i;
    const Mesh& mesh = scene.meshes[id];
    const bool needs_filter = filter.needs_filter && filter.needs_filter(scene, scene.materials[mesh.material]);
    parts.push_back({&mesh, id, instance, needs_filter});
  }
}

/// Hierarchies count triangles in 32 bits.
void check_count(const std::vector<MeshPart>& parts) {
  std::size_t count = 0;
  for (const MeshPart& part : parts) count += part.mesh->triangles.size();
  if (count >= invalid_id) throw std::runtime_error("too many triangles for one hierarchy");
}

Bounds object_bounds(const Scene& scene, const Object& object) {
  Bounds bounds;
  for (std::uint32_t i = 0; i < object.mesh_count; ++i) {
    for (const Vec3& p : scene.meshes[object.first_mesh + i].positions) bounds.add(p);
  }
  return bounds;
}

Bounds world_bounds(const Bounds& object, const Affine& to_world) {
  Bounds bounds;
  if (object.is_empty()) return bounds;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner(object.corner(i));
    bounds.add(Vec3(glm::dmat3(to_world.linear) * corner + glm::dvec3(to_world.translation)));
  }
  return widened(bounds);
}

}  // namespace

std::vector<MeshPart> world_space_parts(const Scene& scene, HitFilter filter) {
  std::vector<MeshPart> parts;
  for (std::uint32_t id = 0; id < scene.instances.size(); ++id) {
    const Instance& instance = scene.instances[id];
    if (instance.is_world_space) append_parts(scene, filter, scene.objects[instance.object], id, parts);
  }
  check_count(parts);
  return parts;
}

std::vector<MeshPart> object_parts(const Scene& scene, HitFilter filter, std::size_t object) {
  std::vector<MeshPart> parts;
  append_parts(scene, filter, scene.objects[object], invalid_id, parts);
  check_count(parts);
  return parts;
}

std::vector<InstancePlacement> instance_placements(const Scene& scene) {
  std::vector<InstancePlacement> placements;
  for (std::uint32_t id = 0; id < scene.instances.size(); ++id) {
    const Instance& instance = scene.instances[id];
    if (instance.is_world_space || !is_invertible(instance.to_world)) continue;
    const Mat3 to_object(glm::inverse(glm::dmat3(instance.to_world.linear)));
    placements.push_back({to_object, instance.to_world.translation, id, instance.object});
  }
  return placements;
}

void append_instance_bounds(const Scene& scene, const std::vector<InstancePlacement>& placements,
                            std::vector<Bounds>& boxes) {
  std::vector<Bounds> of_objects(scene.objects.size());
  std::vector<bool> is_known(scene.objects.size());
  for (const InstancePlacement& placement : placements) {
    if (!is_known[placement.object]) {
      of_objects[placement.object] = object_bounds(scene, scene.objects[placement.object]);
      is_known[placement.object] = true;
    }
    boxes.push_back(world_bounds(of_objects[placement.object], scene.instances[placement.instance].to_world));
  }
}

}  // namespace candil

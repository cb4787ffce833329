/// A scene taken apart for the hierarchies of core/bvh/two_level.h.
#pragma once

#include <vector>

#include "core/accelerator.h"
#include "core/bvh/mesh_part.h"

namespace candil {

/// An instance that rays can hit: 56 bytes, and what its box takes.
struct InstancePlacement {
  Mat3 to_object_linear{1.0f};
  Vec3 translation{0.0f};      ///< Of the instance in the world.
  std::uint32_t instance = 0;  ///< Into Scene::instances.
  std::uint32_t object = 0;    ///< Into Scene::objects.

  /// The ray in object space; its direction has any length, its t are those of the world. Subtracting first keeps the
  /// error relative to the distance between ray and instance, wherever both are.
  Ray to_object(const Ray& ray) const {
    return {to_object_linear * (ray.origin - translation), to_object_linear * ray.direction, ray.t_max};
  }
};

/// The meshes of all instances that are in world space.
std::vector<MeshPart> world_space_parts(const Scene& scene, HitFilter filter);

/// The meshes of an object, in order.
std::vector<MeshPart> object_parts(const Scene& scene, HitFilter filter, std::size_t object);

/// All other instances, without those whose transform is flat or not finite: no ray can hit them.
std::vector<InstancePlacement> instance_placements(const Scene& scene);

/// Appends the world box of each placement, with margin, in order.
void append_instance_bounds(const Scene& scene, const std::vector<InstancePlacement>& placements,
                            std::vector<Bounds>& boxes);

}  // namespace candil

/// Two hierarchies made into an accelerator: one class of them holds triangles, the other the boxes of what is more.
///
/// - All meshes in world space are in one hierarchy of triangles.
/// - Every object that instances use has one in object space, which they share.
/// - Bounded shapes and instances are in one hierarchy of boxes. Planes, which have no box, are asked first.
/// A contestant provides, as core/bvh/brute.h does:
///     class XTriangles {
///       static XTriangles build(std::span<const MeshPart>, const AcceleratorOptions&);  // on the threads of the
///       calling task arena template <typename Accept> void intersect(const Ray&, TriangleHit& nearest, const Accept&)
///       const; template <typename Accept> bool occluded(const Ray&, float t_max, const Accept&) const; std::size_t
///       memory_bytes() const; };
///     class XBoxes {
///       static XBoxes build(std::span<const Bounds>, const AcceleratorOptions&);
///       template <typename Visit> void intersect(const Ray&, float& t_max, const Visit&) const;
///       template <typename Visit> bool occluded(const Ray&, float t_max, const Visit&) const;
///       std::size_t memory_bytes() const; };
/// Rays in object space have directions of any length, so that t is that of the world. `accept(candidate,
/// is_front_face)` is asked for hits on parts that need a filter, and no others. `visit(item, t_max)` may lower t_max;
/// `visit(item)` of occluded() tells whether something is in the way.
#pragma once

#include <tbb/parallel_for.h>

#include <optional>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/box_test.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/scene_parts.h"
#include "core/shape_target.h"

namespace candil {

template <typename Triangles, typename Boxes>
class TwoLevelAccelerator final : public Accelerator {
 public:
  TwoLevelAccelerator(const Scene& scene, HitFilter filter, const AcceleratorOptions& options)
      : scene_(scene),
        filter_(filter),
        planes_(scene, filter),
        shapes_(bounded_shapes(scene, filter)),
        world_parts_(world_space_parts(scene, filter)),
        placements_(instance_placements(scene)),
        objects_(scene.objects.size()) {
    std::vector<bool> is_placed(scene.objects.size());
    for (const InstancePlacement& placement : placements_) is_placed[placement.object] = true;
    tbb::parallel_for(std::size_t{0}, objects_.size(), [&](std::size_t object) {
      if (is_placed[object]) objects_[object] = Triangles::build(object_parts(scene, filter, object), options);
    });
    world_ = Triangles::build(world_parts_, options);
    std::vector<Bounds> boxes;
    boxes.reserve(shapes_.size() + placements_.size());
    for (const ShapeTarget& shape : shapes_) boxes.push_back(shape.bounds());
    append_instance_bounds(scene, placements_, boxes);
    items_ = Boxes::build(boxes, options);
  }

  std::optional<Hit> intersect(const Ray& ray) const override {
    std::optional<Hit> hit(std::in_place);
    find(ray, *hit);
    if (hit->is_miss()) hit.reset();
    return hit;
  }

  void intersect_each(std::span<const Ray> rays, std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) find(rays[i], hits[i]);
  }

  bool occluded(const Ray& ray) const override {
    if (!planes_.is_empty() && planes_.occluded(ray)) return true;
    const auto accept = [&](const TriangleHit& candidate, bool is_front_face) {
      return is_accepted(ray, world_hit(candidate), is_front_face);
    };
    if (world_.occluded(ray, ray.t_max, accept)) return true;
    if (!has_items()) return false;
    return items_.occluded(ray, ray.t_max, [&](std::uint32_t item) {
      if (item < shapes_.size()) return !shapes_[item].intersect(ray, ray.t_max).is_miss();
      const InstancePlacement& placement = placements_[item - shapes_.size()];
      return objects_[placement.object]->occluded(placement.to_object(ray), ray.t_max, filter_of(ray, placement));
    });
  }

  std::size_t memory_bytes() const override {
    std::size_t bytes = world_.memory_bytes() + items_.memory_bytes() + shapes_.size() * sizeof(ShapeTarget) +
                        world_parts_.size() * sizeof(MeshPart) + placements_.size() * sizeof(InstancePlacement);
    for (const std::optional<Triangles>& object : objects_) bytes += sizeof(object);
    for (const std::optional<Triangles>& object : objects_) bytes += object ? object->memory_bytes() : 0;
    return bytes;
  }

 private:
  bool has_items() const { return !shapes_.empty() || !placements_.empty(); }

  bool is_accepted(const Ray& ray, const Hit& hit, bool is_front_face) const {
    return filter_.accept(scene_, ray, hit, is_front_face);
  }
  Hit world_hit(const TriangleHit& found) const {
    const MeshPart& part = world_parts_[found.part];
    return {found.t, found.barycentric, part.instance, part.mesh_id, found.triangle};
  }
  Hit instance_hit(const TriangleHit& found, const InstancePlacement& placement) const {
    const std::uint32_t mesh = scene_.objects[placement.object].first_mesh + found.part;
    return {found.t, found.barycentric, placement.instance, mesh, found.triangle};
  }
  /// The filter for hits of an instance; it gets the ray of the world.
  auto filter_of(const Ray& ray, const InstancePlacement& placement) const {
    return [this, &ray, &placement](const TriangleHit& candidate, bool is_front_face) {
      return is_accepted(ray, instance_hit(candidate, placement), is_front_face);
    };
  }

  /// The answer, or a miss, into `hit`.
  void find(const Ray& ray, Hit& hit) const {
    hit.t = infinity;
    float t_max = ray.t_max;
    if (!planes_.is_empty()) {
      hit = planes_.intersect(ray);
      t_max = glm::min(t_max, hit.t);
    }
    TriangleHit nearest{.t = t_max};
    world_.intersect(ray, nearest, [&](const TriangleHit& candidate, bool is_front_face) {
      return is_accepted(ray, world_hit(candidate), is_front_face);
    });
    if (nearest.part != invalid_id) hit = world_hit(nearest);
    if (!has_items()) return;
    items_.intersect(ray, nearest.t, [&](std::uint32_t item, float& t_end) {
      if (item < shapes_.size()) {
        const Hit found = shapes_[item].intersect(ray, t_end);
        if (!found.is_miss()) hit = found, t_end = found.t;
        return;
      }
      const InstancePlacement& placement = placements_[item - shapes_.size()];
      TriangleHit inside{.t = t_end};
      objects_[placement.object]->intersect(placement.to_object(ray), inside, filter_of(ray, placement));
      if (inside.part != invalid_id) hit = instance_hit(inside, placement), t_end = inside.t;
    });
  }

  const Scene& scene_;
  HitFilter filter_;
  PlaneSet planes_;
  std::vector<ShapeTarget> shapes_;
  std::vector<MeshPart> world_parts_;
  std::vector<InstancePlacement> placements_;
  std::vector<std::optional<Triangles>> objects_;  // in object space; empty where no instance uses it
  Triangles world_;
  Boxes items_;  // over shapes_, then placements_
};

}  // namespace candil

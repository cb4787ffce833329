/// Shapes as accelerators see them: intersection and hit filter together.
#pragma once

#include <vector>

#include "core/accelerator.h"
#include "core/shape.h"

namespace candil {

/// One shape that rays may hit. The scene must outlive it.
class ShapeTarget {
 public:
  ShapeTarget(const Scene& scene, HitFilter filter, std::uint32_t shape);

  /// The nearest accepted hit with t in [0, t_max], or a miss. A sphere's far side counts when its near one is out of
  /// range or not accepted. The filter gets `ray` as it is.
  Hit intersect(const Ray& ray, float t_max) const;
  Bounds bounds() const { return shape_bounds(scene_->shapes[shape_]); }

 private:
  const Scene* scene_;
  HitFilter filter_;  // empty if the material does not need it
  std::uint32_t shape_;
  ShapeIntersector intersector_;
};

/// The spheres and discs of a scene, which have bounds and belong in a hierarchy.
std::vector<ShapeTarget> bounded_shapes(const Scene& scene, HitFilter filter);

/// The infinite planes of a scene, which have none: tested one by one beside the hierarchy. An accelerator asks them
/// first and looks for the rest up to the t that they answer.
class PlaneSet {
 public:
  PlaneSet(const Scene& scene, HitFilter filter);

  bool is_empty() const { return planes_.empty(); }
  /// The nearest accepted hit with t in [0, ray.t_max], or a miss.
  Hit intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

 private:
  std::vector<ShapeTarget> planes_;
};

}  // namespace candil

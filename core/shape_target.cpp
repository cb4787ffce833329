#include "core/shape_target.h"

#include <algorithm>

namespace candil {
namespace {

template <typename Predicate>
std::vector<ShapeTarget> targets_where(const Scene& scene, HitFilter filter, const Predicate& is_wanted) {
  std::vector<ShapeTarget> targets;
  for (std::uint32_t id = 0; id < scene.shapes.size(); ++id) {
    const Shape& shape = scene.shapes[id];
    if (is_wanted(shape.kind) && is_invertible(shape.to_world)) targets.emplace_back(scene, filter, id);
  }
  return targets;
}

}  // namespace

ShapeTarget::ShapeTarget(const Scene& scene, HitFilter filter, std::uint32_t shape)
    : scene_(&scene), shape_(shape), intersector_(scene.shapes[shape]) {
  if (filter.needs_filter && filter.needs_filter(scene, scene.materials[scene.shapes[shape].material]))
    filter_ = filter;
}

Hit ShapeTarget::intersect(const Ray& ray, float t_max) const {
  for (const ShapeCrossing& crossing : intersector_.crossings(ray, t_max)) {
    const Hit hit{crossing.t, crossing.coordinates, invalid_id, invalid_id, shape_};
    if (!filter_.accept || filter_.accept(*scene_, ray, hit, crossing.is_front_face)) return hit;
  }
  return {};
}

std::vector<ShapeTarget> bounded_shapes(const Scene& scene, HitFilter filter) {
  return targets_where(scene, filter, [](ShapeKind kind) { return kind != ShapeKind::plane; });
}

PlaneSet::PlaneSet(const Scene& scene, HitFilter filter)
    : planes_(targets_where(scene, filter, [](ShapeKind kind) { return kind == ShapeKind::plane; })) {}

Hit PlaneSet::intersect(const Ray& ray) const {
  Hit nearest;
  float t_max = ray.t_max;
  for (const ShapeTarget& plane : planes_) {
    const Hit hit = plane.intersect(ray, t_max);
    if (!hit.is_miss()) nearest = hit, t_max = hit.t;
  }
  return nearest;
}

bool PlaneSet::occluded(const Ray& ray) const {
  return std::any_of(planes_.begin(), planes_.end(),
                     [&](const ShapeTarget& plane) { return !plane.intersect(ray, ray.t_max).is_miss(); });
}

}  // namespace candil

/// What Embree calls back during a traversal, and the data that it hands there: for core/embree_accelerator.cpp alone.
#pragma once

#include <vector>

#include "core/accelerator.h"
#include "core/embree_api.h"
#include "core/shape_target.h"

namespace candil::embree {

/// What a geometry id stands for. In the top-level scene the instance is known; in an object's scene the hit tells it.
struct GeometryRecord {
  const Scene* scene = nullptr;
  HitFilter filter;
  const std::vector<std::uint32_t>* instance_of_top_id = nullptr;
  std::uint32_t instance = invalid_id;  // invalid_id: shared by several
  std::uint32_t mesh = invalid_id;      // invalid_id: an Embree instance, or (without an instance either) the shapes
};

/// Handed through Embree to the filter function.
struct FilterContext {
  QueryContext embree;
  const Ray* ray;
};

inline void filter_hit(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& record = *static_cast<const GeometryRecord*>(arguments->geometryUserPtr);
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  RTCHitN* hit = arguments->hit;
  const unsigned n = arguments->N;
  const Vec3 normal(RTCHitN_Ng_x(hit, n, 0), RTCHitN_Ng_y(hit, n, 0), RTCHitN_Ng_z(hit, n, 0));
  RTCRayN* ray = arguments->ray;
  const Vec3 direction(RTCRayN_dir_x(ray, n, 0), RTCRayN_dir_y(ray, n, 0), RTCRayN_dir_z(ray, n, 0));
  const std::uint32_t instance =
      record.instance != invalid_id ? record.instance : (*record.instance_of_top_id)[RTCHitN_instID(hit, n, 0, 0)];
  const Hit candidate{RTCRayN_tfar(ray, n, 0),
                      {RTCHitN_u(hit, n, 0), RTCHitN_v(hit, n, 0)},
                      instance,
                      record.mesh,
                      RTCHitN_primID(hit, n, 0)};
  const bool is_front_face = glm::dot(direction, normal) < 0;  // both in the object's space
  if (!record.filter.accept(*record.scene, *context.ray, candidate, is_front_face)) arguments->valid[0] = 0;
}

// Spheres and discs are one user geometry: its user data is the vector of them. Queries are of single rays, so N is 1.
using Shapes = std::vector<ShapeTarget>;

inline void bound_shape(const RTCBoundsFunctionArguments* arguments) {
  const Bounds bounds = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID].bounds();
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = bounds.low.x, box.lower_y = bounds.low.y, box.lower_z = bounds.low.z;
  box.upper_x = bounds.high.x, box.upper_y = bounds.high.y, box.upper_z = bounds.high.z;
}

inline void intersect_shape(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, 1);
  const ShapeTarget& shape = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID];
  const Hit found = shape.intersect(*context.ray, RTCRayN_tfar(ray, 1, 0));
  if (found.is_miss()) return;
  RTCRayN_tfar(ray, 1, 0) = found.t;
  RTCHitN* hit = RTCRayHitN_HitN(arguments->rayhit, 1);
  RTCHitN_u(hit, 1, 0) = found.barycentric.x;
  RTCHitN_v(hit, 1, 0) = found.barycentric.y;
  RTCHitN_primID(hit, 1, 0) = found.triangle;  // into Scene::shapes
  RTCHitN_geomID(hit, 1, 0) = arguments->geomID;
  RTCHitN_instID(hit, 1, 0, 0) = RTC_INVALID_GEOMETRY_ID;
}

inline void occlude_by_shape(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  const ShapeTarget& shape = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID];
  float& t_far = RTCRayN_tfar(arguments->ray, 1, 0);
  if (!shape.intersect(*context.ray, t_far).is_miss()) t_far = -infinity;
}

}  // namespace candil::embree

/// Embree 3.13 or 4.x behind one set of names, for core/embree_accelerator.cpp alone.
#pragma once

#if CANDIL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <utility>

namespace candil::embree {

#if CANDIL_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
inline void init_context(QueryContext& context) { rtcInitRayQueryContext(&context); }
inline void query_intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
inline void query_occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using QueryContext = RTCIntersectContext;
inline void init_context(QueryContext& context) { rtcInitIntersectContext(&context); }
inline void query_intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}
inline void query_occluded(RTCScene scene, QueryContext& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

/// Owns one reference to an Embree object.
template <typename Handle, void (*release)(Handle)>
class Owner {
 public:
  explicit Owner(Handle handle = nullptr) : handle_(handle) {}
  Owner(Owner&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owner& operator=(Owner&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owner() {
    if (handle_) release(handle_);
  }
  Handle get() const { return handle_; }

 private:
  Handle handle_;
};
using Device = Owner<RTCDevice, rtcReleaseDevice>;
using SceneHandle = Owner<RTCScene, rtcReleaseScene>;
using Geometry = Owner<RTCGeometry, rtcReleaseGeometry>;

}  // namespace candil::embree

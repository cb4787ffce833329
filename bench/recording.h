/// The rays of a render, kept to be shot again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ray.h"
#include "core/scene.h"
#include "integrators/render.h"

namespace candil {

/// What a ray was shot for. Shadow rays ask whether there is anything, the others what is nearest.
enum class RayKind : std::uint8_t {
  primary,         ///< From the camera.
  first_bounce,    ///< From the surface that the camera sees.
  deeper_bounces,  ///< From all surfaces behind that.
  shadow,          ///< Towards a light, from surfaces of any depth.
};
inline constexpr std::size_t ray_kind_count = 4;
inline constexpr std::array ray_kinds = {RayKind::primary, RayKind::first_bounce, RayKind::deeper_bounces,
                                         RayKind::shadow};
/// "primary", "first bounce", "deeper bounces", "shadow".
const char* ray_kind_name(RayKind kind);

/// One value for each kind of ray.
template <typename T>
class PerRayKind {
 public:
  T& operator[](RayKind kind) { return values_[static_cast<std::size_t>(kind)]; }
  const T& operator[](RayKind kind) const { return values_[static_cast<std::size_t>(kind)]; }

 private:
  std::array<T, ray_kind_count> values_{};
};

struct Recording {
  PerRayKind<std::vector<Ray>> rays;  ///< In the order in which the renderer shoots those of a kind.
  std::uint64_t paths = 0;            ///< Whose rays are here, all of them.
  std::uint64_t paths_wanted = 0;     ///< Those of the render; the rest did not fit into the memory.

  std::size_t ray_count() const;
  std::size_t bytes() const { return ray_count() * sizeof(Ray); }
};

/// The rays that `render()` shoots with the `path` integrator and these settings. When they would occupy more than
/// `max_bytes`, whole paths are left out: those of tiles from all over the picture. Runs on one thread.
Recording record_rays(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
                      std::size_t max_bytes);

}  // namespace candil

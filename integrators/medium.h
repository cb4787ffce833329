/// Random walks in volumes that scatter (KHR_materials_volume_scatter, a draft: an experiment).
#pragma once

#include "integrators/path_state.h"

namespace candil {

/// Optical properties of a homogeneous medium, for red, green and blue.
struct Medium {
  Vec3 extinction{0.0f};         ///< Absorbed and scattered, 1/m.
  Vec3 albedo{0.0f};             ///< Share of it that is scattered.
  float scatter_anisotropy = 0;  ///< Henyey and Greenstein's g.
};

/// What a material's volume is made of. `multiscatter_color` is the albedo of a thick body of it; that of one event
/// follows by the fit of Kulla and Conty 2017, as the extension has it.
Medium medium_of(const Material& material);

/// Direction after scattering for light that came along `direction`, by the phase function of Henyey and Greenstein
/// 1941; of density henyey_greenstein(). g > 0 goes on forwards.
Vec3 sample_henyey_greenstein(Vec3 direction, float g, Vec2 u);
/// 1/sr, by the cosine between the directions before and after.
float henyey_greenstein(float cosine, float g);

enum class MediumStep { surface, scattered, ended };

/// Moves a path that is in a scattering medium, `distance` metres before a surface: to it, with what is left of the
/// throughput, or to a point in between where it scatters and its ray starts anew, or to its end.
///
/// The distance is sampled for one channel, chosen by its share of the throughput, and weighed by the densities of all
/// (one-sample balance heuristic; Veach 1997, section 9.2.4): the sum of the throughput's channels never grows. Nothing
/// is estimated towards lights at such a point, since the boundary of the volume bends or blocks the way: what a walk
/// finds counts in full.
MediumStep step_in_medium(PathState& state, const Medium& medium, float distance, const Sampler& sampler);

/// Whether the path's medium scatters.
inline bool is_in_scattering_medium(const PathState& state, const Scene& scene) {
  return state.medium != invalid_id && scene.materials[state.medium].scatters();
}

/// Moves a path through whatever medium it is in, if any, towards the surface `distance` metres on; MediumStep::surface
/// when it gets there.
inline MediumStep cross_medium(PathState& state, const Scene& scene, float distance, const Sampler& sampler) {
  if (is_in_scattering_medium(state, scene)) {
    return step_in_medium(state, medium_of(scene.materials[state.medium]), distance, sampler);
  }
  if (state.medium != invalid_id) state.throughput *= volume_transmittance(scene, state.medium, distance);
  return MediumStep::surface;
}

}  // namespace candil

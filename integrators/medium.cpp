#include "integrators/medium.h"

#include <cmath>

#include "core/frame.h"

namespace candil {
namespace {

/// Walks in bodies of millions of mean free paths would not end. Of white light in a half space, 1 / sqrt(4096 pi) =
/// 0.9 % has not come out by then; of anything darker, much less.
constexpr std::uint32_t most_steps = 4096;

/// Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks".
float single_scattering_albedo(float multiscatter) {
  const float root = std::sqrt(9.59217f + multiscatter * (41.6808f + multiscatter * 17.7126f));
  return glm::clamp(1 - sqr(4.09712f + 4.20863f * multiscatter - root), 0.0f, 1.0f);
}

/// One channel for the distance, by its share of the throughput, which is not black.
int choose_channel(Vec3 share, float u) {
  if (u < share.x) return 0;
  return u < share.x + share.y || share.z == 0 ? 1 : 2;
}

}  // namespace

Medium medium_of(const Material& material) {
  constexpr float least_color = 1e-8f, most_extinction = 1e12f;  // finite even where the file says infinite
  Medium medium;
  for (int c = 0; c < 3; ++c) {
    const float depth = -std::log(glm::max(material.attenuation_color[c], least_color));
    medium.extinction[c] = glm::min(depth / material.attenuation_distance, most_extinction);
    medium.albedo[c] = single_scattering_albedo(material.extensions->multiscatter_color[c]);
  }
  medium.scatter_anisotropy = material.extensions->scatter_anisotropy;
  return medium;
}

float henyey_greenstein(float cosine, float g) {
  const float base = 1 + sqr(g) - 2 * g * cosine;
  return (1 - sqr(g)) / (4 * pi * base * std::sqrt(base));
}

Vec3 sample_henyey_greenstein(Vec3 direction, float g, Vec2 u) {
  float cosine = 1 - 2 * u.x;
  if (std::abs(g) > 1e-3f) {
    const float ratio = (1 - sqr(g)) / (1 + g * cosine);
    cosine = glm::clamp((1 + sqr(g) - sqr(ratio)) / (2 * g), -1.0f, 1.0f);
  }
  const float sine = safe_sqrt(1 - sqr(cosine)), phi = 2 * pi * u.y;
  return glm::normalize(Frame(direction).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine}));
}

MediumStep step_in_medium(PathState& state, const Medium& medium, float distance, const Sampler& sampler) {
  const FourPoints u = sampler.sample_four_2d(dimension::first_medium + dimension::per_vertex * state.medium_steps);
  ++state.medium_steps;
  const Vec3 share = state.throughput / (state.throughput.x + state.throughput.y + state.throughput.z);
  const float extinction = medium.extinction[choose_channel(share, u[0].y)];
  const float free_path = extinction > 0 ? -std::log1p(-u[0].x) / extinction : infinity;
  if (!(free_path < distance)) {
    const Vec3 transmittance = glm::exp(-medium.extinction * distance);
    state.throughput *= transmittance / glm::dot(share, transmittance);
    return MediumStep::surface;
  }
  const Vec3 density = medium.extinction * glm::exp(-medium.extinction * free_path);
  state.throughput *= medium.albedo * density / glm::dot(share, density);
  // Roulette by what was absorbed alone: a lossless walk has to find its way out.
  const float survival = glm::min(max_component(state.throughput) * state.eta_scale, 1.0f);
  if (!(u[2].x < survival) || state.medium_steps >= most_steps) return MediumStep::ended;
  state.throughput /= survival;
  state.from = state.ray.origin + free_path * state.ray.direction;
  state.ray.origin = state.from;
  state.ray.direction = sample_henyey_greenstein(state.ray.direction, medium.scatter_anisotropy, u[1]);
  state.is_specular = true;
  state.sees_backdrop = false;
  return MediumStep::scattered;
}

}  // namespace candil

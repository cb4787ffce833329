/// The steps that integrators of paths share: what a path carries, and how it moves on.
#pragma once

#include "integrators/integrator.h"
#include "materials/bsdf.h"

namespace candil {

struct PathState {
  Ray ray;
  Vec3 throughput{1.0f};  ///< Contribution over density of the path so far.
  Vec3 radiance{0.0f};    ///< Collected so far.
  float eta_scale = 1;  ///< Product of eta^2: what roulette multiplies to undo the compression of radiance in a medium.
  std::uint32_t bounce = 0;           ///< Scattering events at surfaces so far.
  std::uint32_t medium = invalid_id;  ///< Material whose volume the ray crosses, or none.
  std::uint32_t medium_steps = 0;     ///< Parts of the way through scattering media so far.
  float bsdf_pdf = 0;                 ///< Density, 1/sr, with which the last closure chose the ray.
  float wavelength = 0;               ///< Nanometres, from the first dispersive volume on; before that 0.
  Vec3 from{0.0f};                    ///< The last point that scattered, without offset.
  bool is_specular = true;    ///< The ray is a camera ray or left a delta lobe: nothing else could have found it.
  bool sees_backdrop = true;  ///< Camera ray so far, bent at most by specular transmission.
};

/// The random numbers of a vertex, drawn together: a path uses the same ones for the same purpose whatever happens on
/// it.
class VertexSamples {
 public:
  VertexSamples() = default;
  VertexSamples(const Sampler& sampler, std::uint32_t bounce)
      : points_(sampler.sample_four_2d(first_dimension(bounce))) {}
  /// Those of two paths at once: cheaper than one after the other.
  static std::array<VertexSamples, 2> of_two(const std::array<Sampler, 2>& samplers,
                                             const std::array<std::uint32_t, 2>& bounces) {
    const auto [a, b] = Sampler::sample_four_2d(samplers, {first_dimension(bounces[0]), first_dimension(bounces[1])});
    return {VertexSamples(a), VertexSamples(b)};
  }

  /// Point on the light.
  Vec2 light() const { return points_[0]; }
  /// Which light: 48 random bits, for scenes with a million of them.
  double light_choice() const {
    return static_cast<double>(points_[1].x) + 0x1p-24 * static_cast<double>(points_[3].y);
  }
  /// Which lobe of the closure.
  float lobe() const { return points_[1].y; }
  /// Of the closure's sample.
  Vec2 direction() const { return points_[2]; }
  float roulette() const { return points_[3].x; }

 private:
  explicit VertexSamples(const FourPoints& points) : points_(points) {}
  static std::uint32_t first_dimension(std::uint32_t bounce) {
    return dimension::first_vertex + bounce * dimension::per_vertex;
  }

  FourPoints points_;  // as they come: taken apart where they are used
};

/// What is left of light after `distance` metres in the volume of a material: Beer-Lambert with the attenuation colour
/// reached at the attenuation distance (KHR_materials_volume).
Vec3 volume_transmittance(const Scene& scene, std::uint32_t medium, float distance);

/// The medium on the side of the surface that wi leaves to, for a path that came from wo through `current`. Reflection
/// off the outside keeps it; a path that leaves a volume is in none, even if that volume was inside another.
std::uint32_t medium_beyond(const Scene& scene, const SurfacePoint& point, Vec3 wo, Vec3 wi, std::uint32_t current);

/// What chooses a wavelength for the path when a dispersive volume asks for one; see wavelength_at().
Wavelength choose_wavelength(PathState& state, bool is_front, const Sampler& sampler);

/// The wavelength for the closure at `point`; none unless its material disperses light. A path that is outside gets its
/// wavelength's response with what the closure transmits, and has made its choice when it goes that way: reflections
/// off the outside stay white. A path that began inside has to choose before anything else happens to it.
inline Wavelength wavelength_at(PathState& state, const Scene& scene, const SurfacePoint& point,
                                const Sampler& sampler) {
  if (!scene.materials[point.material].is_dispersive()) return {};
  return choose_wavelength(state, glm::dot(state.ray.direction, point.normal_geometric) <= 0, sampler);
}

/// Radiance from beyond the scene for the state's ray, the camera's backdrop included.
Vec3 background(const RenderContext& context, const PathState& state);

/// Samples the closure, made for that wavelength, and turns the state's ray into its direction; false when the path
/// ends here.
inline bool scatter(PathState& state, const Scene& scene, const SurfacePoint& point, const Bsdf& bsdf, float u_lobe,
                    Vec2 u_direction, const Wavelength& wavelength) {
  const Vec3 wo = -state.ray.direction;
  const std::optional<BsdfSample> sample = bsdf.sample(wo, u_lobe, u_direction);
  if (!sample || is_black(sample->weight)) return false;
  state.throughput *= sample->weight;
  state.eta_scale *= sqr(sample->eta);
  state.bsdf_pdf = sample->pdf;
  state.is_specular = sample->is_delta;
  state.sees_backdrop = state.sees_backdrop && sample->is_delta && sample->is_transmission;
  state.from = point.position;
  state.medium = medium_beyond(scene, point, wo, sample->wi, state.medium);
  if (wavelength.nanometres > 0 && state.medium == point.material) state.wavelength = wavelength.nanometres;
  state.ray.origin = offset_origin(point, sample->wi);
  state.ray.direction = sample->wi;
  state.ray.t_max = infinity;
  ++state.bounce;
  return true;
}

/// Russian roulette from the fifth vertex on; false when the path ends here. Its probability follows the throughput
/// without the 1/eta^2 of media, which comes back when the path leaves them (Pharr, Jakob and Humphreys 2023,
/// section 14.4).
inline bool survives_roulette(PathState& state, float u_roulette) {
  constexpr std::uint32_t first_bounce = 5;
  if (state.bounce < first_bounce) return true;
  const float survival = glm::min(max_component(state.throughput) * state.eta_scale, 0.95f);
  if (!(u_roulette < survival)) return false;
  state.throughput /= survival;
  return true;
}

}  // namespace candil

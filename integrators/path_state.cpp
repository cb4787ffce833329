#include "integrators/path_state.h"

namespace candil {

Vec3 volume_transmittance(const Scene& scene, std::uint32_t medium, float distance) {
  const Material& material = scene.materials[medium];
  if (!(material.attenuation_distance < infinity)) return Vec3(1);
  return glm::pow(material.attenuation_color, Vec3(distance / material.attenuation_distance));
}

std::uint32_t medium_beyond(const Scene& scene, const SurfacePoint& point, Vec3 wo, Vec3 wi, std::uint32_t current) {
  if (!scene.materials[point.material].is_volume()) return current;
  if (glm::dot(wi, point.normal_geometric) < 0) return point.material;
  return glm::dot(wo, point.normal_geometric) < 0 ? invalid_id : current;
}

Vec3 background(const RenderContext& context, const PathState& state) {
  const auto& backdrop = context.scene.environment.backdrop;
  if (state.sees_backdrop && backdrop) return *backdrop;
  return context.lights.environment().radiance(state.ray.direction);
}

bool scatter(PathState& state, const Scene& scene, const SurfacePoint& point, const Bsdf& bsdf, float u_lobe,
             Vec2 u_direction) {
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
  state.ray.origin = offset_origin(point, sample->wi);
  state.ray.direction = sample->wi;
  state.ray.t_max = infinity;
  ++state.bounce;
  return true;
}

bool survives_roulette(PathState& state, float u_roulette) {
  constexpr std::uint32_t first_bounce = 5;
  if (state.bounce < first_bounce) return true;
  const float survival = glm::min(max_component(state.throughput) * state.eta_scale, 0.95f);
  if (!(u_roulette < survival)) return false;
  state.throughput /= survival;
  return true;
}

}  // namespace candil

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

Wavelength choose_wavelength(PathState& state, bool is_front, const Sampler& sampler) {
  if (state.wavelength > 0) return {state.wavelength};
  const Wavelength chosen = sample_wavelength(sampler.sample_2d(dimension::wavelength).x);
  if (is_front) return chosen;
  state.throughput *= chosen.response;
  state.wavelength = chosen.nanometres;
  return {state.wavelength};
}

Vec3 background(const RenderContext& context, const PathState& state) {
  const auto& backdrop = context.scene.environment.backdrop;
  if (state.sees_backdrop && backdrop) return *backdrop;
  return context.lights.environment().radiance(state.ray.direction);
}

}  // namespace candil

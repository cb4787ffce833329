// The report's estimator (its equation 5, sections 3.2, 3.3 and 6.1), as a yardstick for path.cpp. At each hit a
// roulette picks one lobe of the material or absorption, with probabilities p_i and 1 - sum p_i, where p_i follows from
// the material alone: max(kd) and max(ks) of Phong and plastic, Fresnel's reflectance and its rest for a dielectric.
// Punctual lights are asked one by one wherever the material is not a delta; lights with a surface and the environment
// are found by chance. What differs from the report, without changing the expected value:
// - the lobe's sample is weighed against the density of all lobes, not of the chosen one alone;
// - sum p_i is limited, since the report only asks that it be below 1.
#include "core/emission.h"
#include "core/punctual.h"
#include "integrators/medium.h"

namespace candil {
namespace {

/// Sum of p_i at the most. A path between mirrors is absorbed after 20 of them on average; the report does not say.
constexpr float most_likely_survival = 0.95f;

/// Light that reaches the surface straight from all punctual lights and goes on to wo.
Vec3 punctual_light(const RenderContext& context, const SurfacePoint& point, const Bsdf& bsdf, Vec3 wo,
                    std::uint32_t medium, RayCounts& rays) {
  Vec3 radiance(0);
  for (const PunctualLight& light : context.scene.punctual_lights) {
    const std::optional<LightSample> sample = sample_punctual(light, point);
    if (!sample) continue;
    const Vec3 f_cos = bsdf.eval(wo, sample->wi).f_cos;
    if (is_black(f_cos)) continue;
    ++rays.shadow;
    if (context.accelerator.occluded(sample->shadow_ray)) continue;
    Vec3 arriving = sample->radiance;
    const std::uint32_t crossed = medium_beyond(context.scene, point, wo, sample->wi, medium);
    if (crossed != invalid_id) arriving *= volume_transmittance(context.scene, crossed, sample->shadow_ray.t_max);
    radiance += f_cos * arriving;
  }
  return radiance;
}

}  // namespace

PathSample trace_classic(const RenderContext& context, const RenderSettings& settings, const Ray& camera_ray,
                         const Sampler& sampler, RayCounts& rays) {
  PathState state;
  state.ray = camera_ray;
  ++rays.camera;
  while (true) {
    const std::optional<Hit> hit = context.accelerator.intersect(state.ray);
    if (!hit) {
      if (state.bounce == 0 && settings.transparent_background) return {};
      state.radiance += state.throughput * background(context, state);
      break;
    }
    const MediumStep step = cross_medium(state, context.scene, hit->t, sampler);
    if (step == MediumStep::ended) break;
    if (step == MediumStep::scattered) {
      ++rays.bounce;
      continue;
    }
    SurfacePoint point = make_surface_point(context.scene, *hit);
    const Vec3 wo = -state.ray.direction;
    const Vec3 emitted = emitted_radiance(context.scene, point, glm::dot(wo, point.normal_geometric) > 0);
    if (!is_black(emitted)) {
      state.radiance += state.throughput * emitted;
      break;
    }
    if (state.bounce >= settings.max_bounces) break;

    face_viewer(point, wo);
    const Wavelength wavelength = wavelength_at(state, context.scene, point, sampler);
    const Bsdf bsdf = make_bsdf(context.scene, context.tables, point, wo, wavelength);
    const VertexSamples u(sampler, state.bounce);
    const float survival = glm::min(bsdf.survival_probability(), most_likely_survival);
    if (!(u.roulette() < survival)) break;  // absorbed
    state.throughput /= survival;
    if (!bsdf.is_purely_delta()) {
      state.radiance += state.throughput * punctual_light(context, point, bsdf, wo, state.medium, rays);
    }
    if (!scatter(state, context.scene, point, bsdf, u.lobe(), u.direction(), wavelength)) break;
    ++rays.bounce;
  }
  return {state.radiance, 1};
}

}  // namespace candil

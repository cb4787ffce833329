// Path tracing with next-event estimation and multiple importance sampling (Kajiya 1986; Veach 1997, chapter 9).
#include "core/emission.h"
#include "integrators/path_state.h"

namespace candil {
namespace {

/// Weight of a strategy with density `pdf` beside one with density `other` (power heuristic, beta = 2).
float mis_weight(float pdf, float other) {
  // Divided first: the squares of large densities overflow.
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

/// Light that reaches the surface straight from a sampled light and goes on to wo.
Vec3 direct_light(const RenderContext& context, const SurfacePoint& point, const Bsdf& bsdf, Vec3 wo, double u_pick,
                  Vec2 u_light, std::uint32_t medium, RayCounts& rays) {
  const std::optional<LightSample> light = context.lights.sample(point, u_pick, u_light);
  if (!light || is_black(light->radiance)) return Vec3(0);
  const BsdfEval scattered = bsdf.eval(wo, light->wi);
  if (is_black(scattered.f_cos)) return Vec3(0);
  ++rays.shadow;
  if (context.accelerator.occluded(light->shadow_ray)) return Vec3(0);
  const float weight = light->is_delta ? 1.0f : mis_weight(light->pdf, scattered.pdf);
  Vec3 radiance = scattered.f_cos * light->radiance * (weight / light->pdf);
  const std::uint32_t crossed = medium_beyond(context.scene, point, light->wi, medium);
  if (crossed != invalid_id) radiance *= volume_transmittance(context.scene, crossed, light->shadow_ray.t_max);
  return radiance;
}

/// Weight of light that the closure's own sample ran into.
float weight_of_found_light(const PathState& state, float light_pdf) {
  return state.is_specular ? 1.0f : mis_weight(state.bsdf_pdf, light_pdf);
}

}  // namespace

PathSample trace_path(const RenderContext& context, const RenderSettings& settings, const Ray& camera_ray,
                      const Sampler& sampler, RayCounts& rays) {
  PathState state;
  state.ray = camera_ray;
  ++rays.camera;
  while (true) {
    const std::optional<Hit> hit = context.accelerator.intersect(state.ray);
    if (!hit) {
      if (state.bounce == 0 && settings.transparent_background) return {};
      const float weight = weight_of_found_light(state, context.lights.pdf_miss(state.ray.direction));
      state.radiance += state.throughput * background(context, state) * weight;
      break;
    }
    prefetch_triangle(context.scene, *hit);
    const VertexSamples u = draw_vertex_samples(sampler, state.bounce);
    if (state.medium != invalid_id) state.throughput *= volume_transmittance(context.scene, state.medium, hit->t);

    const SurfacePoint point = make_surface_point(context.scene, *hit);
    const Vec3 wo = -state.ray.direction;
    const Vec3 emitted = emitted_radiance(context.scene, point, glm::dot(wo, point.normal_geometric) > 0);
    if (!is_black(emitted)) {
      const float light_pdf = state.is_specular ? 0 : context.lights.pdf_hit(state.from, point);
      state.radiance += state.throughput * emitted * weight_of_found_light(state, light_pdf);
    }
    if (state.bounce >= settings.max_bounces) break;

    const Bsdf bsdf = make_bsdf(context.scene, context.tables, point, wo);
    if (!bsdf.is_purely_delta() && !context.lights.is_empty()) {
      state.radiance +=
          state.throughput * direct_light(context, point, bsdf, wo, u.light_choice, u.light, state.medium, rays);
    }
    if (!scatter(state, context.scene, point, bsdf, u.lobe, u.direction)) break;
    if (!survives_roulette(state, u.roulette)) break;
    ++rays.bounce;
  }
  return {state.radiance, 1};
}

}  // namespace candil

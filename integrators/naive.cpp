// Path tracing in its plainest form: the light that the closure's samples happen to find. Slow, and easy to check by
// eye.
#include "core/emission.h"
#include "integrators/medium.h"

namespace candil {

PathSample trace_naive(const RenderContext& context, const RenderSettings& settings, const Ray& camera_ray,
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
    state.radiance +=
        state.throughput * emitted_radiance(context.scene, point, glm::dot(wo, point.normal_geometric) > 0);
    if (state.bounce >= settings.max_bounces) break;
    face_viewer(point, wo);
    const Wavelength wavelength = wavelength_at(state, context.scene, point, sampler);
    const Bsdf bsdf = make_bsdf(context.scene, context.tables, point, wo, wavelength);
    const VertexSamples u(sampler, state.bounce);
    if (!scatter(state, context.scene, point, bsdf, u.lobe(), u.direction(), wavelength)) break;
    if (!survives_roulette(state, u.roulette())) break;
    ++rays.bounce;
  }
  return {state.radiance, 1};
}

}  // namespace candil

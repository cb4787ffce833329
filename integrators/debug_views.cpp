// Views of the first hit, for looking into a scene rather than at it.
#include "integrators/first_hit.h"

namespace candil {
namespace {

template <typename Color>
PathSample show_first_hit(const RenderContext& context, const Ray& ray, RayCounts& rays, const Color& color) {
  ++rays.camera;
  const std::optional<Hit> hit = context.accelerator.intersect(ray);
  if (!hit) return {};
  return {color(make_first_hit(context, ray, *hit)), 1};
}

}  // namespace

PathSample show_normals(const RenderContext& context, const RenderSettings&, const Ray& ray, const Sampler&,
                        RayCounts& rays) {
  return show_first_hit(context, ray, rays,
                        [](const FirstHit& hit) { return 0.5f * hit.bsdf.shading_normal() + 0.5f; });
}

PathSample show_albedo(const RenderContext& context, const RenderSettings&, const Ray& ray, const Sampler&,
                       RayCounts& rays) {
  return show_first_hit(context, ray, rays, [](const FirstHit& hit) { return hit.albedo; });
}

}  // namespace candil

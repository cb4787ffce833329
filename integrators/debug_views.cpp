// Views of the first hit, for looking into a scene rather than at it.
#include "integrators/integrator.h"
#include "materials/bsdf.h"

namespace candil {
namespace {

template <typename Color>
PathSample show_first_hit(const RenderContext& context, const Ray& ray, RayCounts& rays, const Color& color) {
  ++rays.camera;
  const std::optional<Hit> hit = context.accelerator.intersect(ray);
  if (!hit) return {};
  const SurfacePoint point = make_surface_point(context.scene, *hit);
  return {color(point, make_bsdf(context.scene, context.tables, point, -ray.direction)), 1};
}

}  // namespace

PathSample show_normals(const RenderContext& context, const RenderSettings&, const Ray& ray, const Sampler&,
                        RayCounts& rays) {
  return show_first_hit(context, ray, rays,
                        [](const SurfacePoint&, const Bsdf& bsdf) { return 0.5f * bsdf.shading_normal() + 0.5f; });
}

PathSample show_albedo(const RenderContext& context, const RenderSettings&, const Ray& ray, const Sampler&,
                       RayCounts& rays) {
  return show_first_hit(context, ray, rays, [&](const SurfacePoint& point, const Bsdf& bsdf) {
    return context.scene.materials[point.material].is_emissive() ? Vec3(1) : bsdf.albedo();
  });
}

}  // namespace candil

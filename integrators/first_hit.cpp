#include "integrators/first_hit.h"

#include "core/emission.h"

namespace candil {

FirstHit make_first_hit(const RenderContext& context, const Ray& ray, const Hit& hit) {
  SurfacePoint point = make_surface_point(context.scene, hit);
  const Vec3 position = point.position, wo = -ray.direction;
  const Vec3 emitted = emitted_radiance(context.scene, point, glm::dot(wo, point.normal_geometric) > 0);
  face_viewer(point, wo);
  const Bsdf bsdf = make_bsdf(context.scene, context.tables, point, wo);
  return {position, bsdf, glm::min(bsdf.albedo() + emitted, Vec3(1))};
}

}  // namespace candil

#include "materials/alpha.h"

#include "core/emission.h"
#include "core/hash.h"
#include "core/shape.h"

namespace candil {
namespace {

bool needs_filter(const Scene&, const Material& material) {
  const bool culls_back = !material.is_double_sided && !material.is_transmissive();
  return culls_back || material.alpha_mode != AlphaMode::opaque;
}

/// Random number in [0, 1) of a ray meeting a triangle, or one side of a shape: a ray may meet both of a sphere's.
float coverage_threshold(const Ray& ray, const Hit& hit, bool is_front_face) {
  const bool is_back_of_shape = hit.is_shape() && !is_front_face;
  std::uint32_t seed = hash_combine(hash(hit.triangle), is_back_of_shape ? hit.mesh - 1 : hit.mesh);
  seed = hash_combine(hash_combine(seed, hit.instance), ray.origin);
  return to_unit_float(hash_combine(seed, ray.direction));
}

bool accept(const Scene& scene, const Ray& ray, const Hit& hit, bool is_front_face) {
  const Material& material = scene.materials[material_of(scene, hit)];
  if (!is_front_face && !material.is_double_sided && !material.is_transmissive()) return false;
  if (material.alpha_mode == AlphaMode::opaque) return true;
  const SurfacePoint point = make_surface_point(scene, hit);
  const float coverage = alpha_coverage(scene, material, point.uv, point.color);
  if (coverage >= 1) return true;
  return coverage > 0 && coverage_threshold(ray, hit, is_front_face) < coverage;
}

}  // namespace

HitFilter alpha_filter() { return {needs_filter, accept}; }

}  // namespace candil

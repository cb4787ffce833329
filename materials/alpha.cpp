#include "materials/alpha.h"

#include "core/emission.h"
#include "core/hash.h"
#include "core/surface.h"

namespace candil {
namespace {

bool needs_filter(const Scene&, const Material& material) {
  const bool culls_back = !material.is_double_sided && !material.is_transmissive();
  return culls_back || material.alpha_mode != AlphaMode::opaque;
}

/// Random number in [0, 1) of a ray meeting a triangle.
float coverage_threshold(const Ray& ray, const Hit& hit) {
  std::uint32_t seed = hash_combine(hash(hit.triangle), hit.mesh);
  seed = hash_combine(hash_combine(seed, hit.instance), ray.origin);
  return to_unit_float(hash_combine(seed, ray.direction));
}

bool accept(const Scene& scene, const Ray& ray, const Hit& hit, bool is_front_face) {
  const Material& material = scene.materials[scene.meshes[hit.mesh].material];
  if (!is_front_face && !material.is_double_sided && !material.is_transmissive()) return false;
  if (material.alpha_mode == AlphaMode::opaque) return true;
  const SurfacePoint point = make_surface_point(scene, hit);
  const float coverage = alpha_coverage(scene, material, point.uv, point.color);
  if (coverage >= 1) return true;
  return coverage > 0 && coverage_threshold(ray, hit) < coverage;
}

}  // namespace

HitFilter alpha_filter() { return {needs_filter, accept}; }

}  // namespace candil

/// The closure of one hit: how light scatters there. A value on the stack, made once per hit by make_bsdf(), with every
/// texture already read.
///
/// Directions: `wo` points to the previous vertex (towards the camera), `wi` to the next one (towards the light); both
/// are unit vectors in world space and point away from the surface. Radiance flows from wi to wo: for transmission into
/// a medium of relative index eta the values contain the factor 1/eta^2 of radiance (Veach 1997, section 5.2).
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/surface.h"
#include "materials/bsdf_tables.h"
#include "materials/dielectric.h"
#include "materials/opaque.h"

namespace candil {

class Bsdf {
 public:
  /// f |cos| and the density of sample(), 1/sr, over all lobes; delta lobes add nothing to either.
  BsdfEval eval(Vec3 wo, Vec3 wi) const;
  /// A direction; nothing when the path ends here (absorbed, or below the surface). u in [0, 1).
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction) const;
  /// Only delta lobes: light sampling cannot contribute.
  bool is_purely_delta() const { return is_lambertian_ ? is_black(diffuse_) : has_only_delta_lobes(); }
  /// Reflectance and transmittance together, roughly, for feature images; in [0, 1].
  Vec3 albedo() const;
  /// Unit, on the side of wo, after normal mapping.
  Vec3 shading_normal() const { return frame_.normal; }

 private:
  friend Bsdf make_bsdf(const Scene&, const BsdfTables&, const SurfacePoint&, Vec3 wo);
  Bsdf(Vec3 shading_normal, Vec3 geometric_normal) : frame_(shading_normal), geometric_normal_(geometric_normal) {}
  /// Whether wi leaves on the side that the local frame and the flat triangle agree on.
  bool sides_agree(Vec3 wi, float local_z) const { return glm::dot(wi, geometric_normal_) * local_z > 0; }

  bool has_only_delta_lobes() const;
  std::optional<BsdfSample> sample_lambertian(Vec2 u) const;

  Frame frame_;                  // z: shading normal, on the side of wo
  Vec3 geometric_normal_;        // on the side of wo
  bool is_lambertian_ = false;   // diffuse_ alone; no lobes
  Vec3 diffuse_;                 // albedo; has a value if is_lambertian_
  float dielectric_weight_ = 0;  // 0: opaque lobes only; 1: dielectric lobes only
  // Each is there when the weight gives it a share; most surfaces never pay for the other.
  std::optional<OpaqueLobes> opaque_;
  std::optional<DielectricLobes> dielectric_;
};

/// The closure of the glTF material at a point, seen from `wo`.
Bsdf make_bsdf(const Scene& scene, const BsdfTables& tables, const SurfacePoint& point, Vec3 wo);

}  // namespace candil

/// A clear coat: one GGX lobe of index 1.5 on top of a closure (KHR_materials_clearcoat), with a normal of its own.
///
/// What lies below gets what the lobe leaves over of light towards wo (albedo scaling), so that white stays white in a
/// furnace, whatever is below: mirrors and glass too. The price: light that bends on its way through is attenuated by
/// the direction of wo alone, and coated closures are not reciprocal. Thin walls have the coat on the side of wo;
/// volumes have it outside, and DielectricLobes deal with it from inside. What facets reflect onto other facets counts
/// as let through, too: a second facet of this index would transmit 91 % of it on average. Directions are in world
/// space.
#pragma once

#include <optional>

#include "core/frame.h"
#include "materials/bsdf_sample.h"
#include "materials/fresnel.h"
#include "materials/graded_albedo.h"

namespace candil {

inline constexpr float clearcoat_f0 = 0.04f;  ///< ((1.5 - 1) / (1.5 + 1))^2

struct ClearcoatParameters {
  float weight = 0;      ///< In [0, 1], of the layer.
  float roughness = 0;   ///< Perceptual.
  Vec3 normal{0, 0, 1};  ///< Unit, wo above it.
};

/// Of a smooth coat, by Schlick's approximation.
inline float clearcoat_reflectance(float cosine) { return fresnel_schlick(Vec3(clearcoat_f0), Vec3(1), cosine).x; }

class ClearcoatLobe {
 public:
  ClearcoatLobe(const ClearcoatParameters& parameters, const GradedGgxAlbedo& table, Vec3 wo);

  BsdfEval eval(Vec3 wo, Vec3 wi) const;
  /// Of a smooth coat a mirror's sample, chosen for certain; else a direction with the density that eval() tells.
  std::optional<BsdfSample> sample(Vec3 wo, Vec2 u) const;
  bool is_delta() const { return is_delta_; }
  /// Energy that it returns towards wo, in [0, 1].
  float albedo() const { return albedo_; }

 private:
  Frame frame_;
  float weight_, alpha_;
  bool is_delta_;
  float albedo_;
};

}  // namespace candil

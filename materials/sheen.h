/// Sheen: the glow of fibres on top of a closure (KHR_materials_sheen).
///
/// What lies below gets what the albedo towards wo leaves over, by the largest component of the colour: the simpler
/// form of the extension's albedo scaling, which keeps white exactly white. (The form with the smaller of both
/// directions' factors is reciprocal, and darkens.) Where the model returns more than it gets, it is scaled down to
/// return all. Directions are in world space.
#pragma once

#include <optional>

#include "materials/bsdf_sample.h"
#include "materials/sheen_albedo.h"

namespace candil {

struct SheenParameters {
  Vec3 color{0.0f};     ///< Each in [0, 1].
  float roughness = 0;  ///< Perceptual.
};

class SheenLobe {
 public:
  /// `normal`: unit, wo above it.
  SheenLobe(const SheenParameters& parameters, const SheenAlbedo& table, Vec3 normal, Vec3 wo);

  BsdfEval eval(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, Vec2 u) const;
  Vec3 normal() const { return normal_; }
  /// Energy that it returns towards wo, in [0, 1].
  Vec3 albedo() const { return color_ * albedo_; }
  /// Of the most reflecting component: what what lies below does not get.
  float taken() const { return max_component(color_) * albedo_; }

 private:
  Vec3 normal_, color_;
  float alpha_;
  float albedo_;  // of white sheen
  float cosine_o_, lambda_o_;
  float scale_;  // of the model, so that it makes no energy
};

}  // namespace candil

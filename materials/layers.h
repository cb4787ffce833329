/// What lies on a closure: a clear coat on top, sheen below it, each if there is one. A layer reflects, and lets
/// through to what is below what its albedo leaves over.
#pragma once

#include <optional>

#include "materials/clearcoat.h"
#include "materials/sheen.h"

namespace candil {

/// Directions are in world space; `normal_of_sides` is on the side of wo, and the layers scatter nothing behind it.
class Layers {
 public:
  /// `base_albedo`: of the closure below, roughly; decides how often each layer is sampled.
  Layers(const std::optional<ClearcoatLobe>& coat, const std::optional<SheenLobe>& sheen, Vec3 base_albedo);

  /// All of it, from what the closure below says for the same directions.
  BsdfEval over(const BsdfEval& base, Vec3 wo, Vec3 wi, Vec3 normal_of_sides) const;

  enum class Part { coat, sheen, base };
  struct Choice {
    Part part;
    float probability;
    float u_rest;  ///< What is left of the number that chose, in [0, 1).
  };
  Choice choose(float u_lobe) const;
  /// The layer's own sample, which may come from behind the surface.
  std::optional<BsdfSample> sample(Part layer, Vec3 wo, Vec2 u) const {
    return layer == Part::coat ? coat_->sample(wo, u) : sheen_->sample(wo, u);
  }

  bool is_purely_delta() const { return !sheen_ && coat_->is_delta(); }
  /// Factor of all that the closure below scatters towards wo.
  float base_scale() const { return base_scale_; }
  /// Energy that the layers themselves return towards wo.
  Vec3 albedo() const { return albedo_; }

 private:
  std::optional<ClearcoatLobe> coat_;
  std::optional<SheenLobe> sheen_;
  float sheen_scale_, base_scale_;  // what reaches them
  Vec3 albedo_;
  float coat_probability_, sheen_probability_, base_probability_;
};

}  // namespace candil

/// What closures answer.
#pragma once

#include <optional>

#include "core/math.h"

namespace candil {

struct BsdfEval {
  Vec3 f_cos{0.0f};  ///< BSDF times |cos(theta_i)|.
  float pdf = 0;     ///< 1/sr.
};

struct BsdfSample {
  Vec3 wi{0.0f};
  Vec3 weight{0.0f};  ///< f |cos| / pdf of all lobes that could have given wi; finite, also for delta lobes.
  float pdf = 0;      ///< 1/sr, of all lobes; for a delta lobe the probability of choosing it.
  float eta = 1;      ///< Index of refraction beyond the interface over the one before it; 1 unless refracted.
  bool is_delta = false;
  bool is_transmission = false;
};

/// The sample of a direction that was chosen by `value.pdf`; nothing where that is not positive.
inline std::optional<BsdfSample> sample_of(Vec3 wi, const BsdfEval& value) {
  if (!(value.pdf > 0)) return std::nullopt;
  BsdfSample sample;
  sample.wi = wi;
  sample.weight = value.f_cos / value.pdf;
  sample.pdf = value.pdf;
  return sample;
}

/// The sample of a mirror, chosen with that probability; `reflectance` / `probability` is its weight.
inline BsdfSample mirror_sample(Vec3 wo, Vec3 reflectance, float probability) {
  BsdfSample sample;
  sample.wi = {-wo.x, -wo.y, wo.z};
  sample.weight = reflectance / probability;
  sample.pdf = probability;
  sample.is_delta = true;
  return sample;
}

}  // namespace candil

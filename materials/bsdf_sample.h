/// What closures answer.
#pragma once

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

}  // namespace candil

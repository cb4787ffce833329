/// What choosing a point on a light, or a direction to it, answers.
#pragma once

#include "core/ray.h"

namespace candil {

struct LightSample {
  Vec3 wi{0.0f};        ///< Unit, from the surface towards the light.
  Vec3 radiance{0.0f};  ///< W/(sr m2) arriving if nothing is in between; for delta lights the irradiance on a surface
                        ///< that faces the light. May be black.
  float pdf = 0;   ///< 1/sr, the choice of the light included; for delta lights the probability of that choice alone.
  Ray shadow_ray;  ///< From the surface, offset, to the light: occluded means in shadow.
  bool is_delta = false;  ///< No other strategy can find this light: no MIS weight.
};

}  // namespace candil

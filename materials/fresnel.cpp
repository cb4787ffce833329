#include "materials/fresnel.h"

namespace candil {

Vec3 fresnel_conductor_average(Vec3 eta, Vec3 k) {
  // Midpoints in the squared cosine, over which the cosine-weighted mean is a plain one.
  constexpr int count = 512;
  Vec3 sum(0);
  for (int i = 0; i < count; ++i) {
    const float squared_cosine = (static_cast<float>(i) + 0.5f) / count;
    sum += fresnel_conductor(glm::sqrt(squared_cosine), eta, k);
  }
  return sum / static_cast<float>(count);
}

}  // namespace candil

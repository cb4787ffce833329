#include "materials/graded_albedo.h"

#include <cmath>

#include "materials/clearcoat.h"
#include "materials/facet_energy.h"
#include "materials/table_rows.h"

namespace candil {
namespace {

constexpr int sample_count = 610;

/// Points of a Fibonacci lattice on one half of the visible facets: the other half mirrors it.
const std::array<Vec2, sample_count> facet_samples = [] {
  std::array<Vec2, sample_count> samples;
  constexpr int previous_fibonacci_number = 377;
  for (int i = 0; i < sample_count; ++i) {
    const int permuted = i * previous_fibonacci_number % sample_count;
    samples[i] = {0.5f * (static_cast<float>(i) + 0.5f) / sample_count,
                  (static_cast<float>(permuted) + 0.5f) / sample_count};
  }
  return samples;
}();

/// Energy of a facet seen from inside, where the coat adds to what it reflects and takes from what it transmits.
float energy_by_coat(Vec3 wo, Vec3 h, float alpha, float eta) {
  const float cosine = glm::dot(wo, h);
  if (cosine <= 0) return 0;
  const float reflectance = fresnel_dielectric(cosine, eta);
  if (reflectance >= 1) return 0;
  const float masking = ggx_masking(wo, alpha);
  const Vec3 reflected = 2 * cosine * h - wo, refracted = refract(wo, h, eta);
  float difference = 0;
  if (reflected.z > 0) difference += ggx_masking_shadowing(wo, reflected, alpha) / masking;
  if (refracted.z < 0) difference -= ggx_masking_shadowing(wo, refracted, alpha) / masking;
  return (1 - reflectance) * clearcoat_reflectance(-glm::dot(refracted, h)) * difference;
}

/// A column of ReshapedDielectric by one facet. Reflectance follows from another eta.
Vec3 reshaped_by_facet(Vec3 wo, Vec3 h, float alpha, float eta, float reflecting_eta, bool has_coat_beyond) {
  const float cosine = glm::dot(wo, h), less_kept = less_kept_by_reflecting(wo, h, alpha, eta);
  if (less_kept == 0) return Vec3(0);
  const float by_coat =
      has_coat_beyond ? -less_kept * clearcoat_reflectance(safe_sqrt(1 - (1 - sqr(cosine)) / sqr(eta))) : 0.0f;
  return {less_kept, less_kept * fresnel_dielectric(cosine, reflecting_eta), by_coat};
}

/// Indices of refraction from the least to the greatest whose albedos are linear in between: within 0.1 %.
int ior_count(float least, float greatest) {
  constexpr float step = 0.06f, most = 8;
  return greatest > least ? 1 + static_cast<int>(std::ceil(glm::min((greatest - least) / step, most))) : 1;
}

}  // namespace

template <typename Value>
template <typename Function>
void GradedGrid<Value>::fill(const Function& value) {
  const auto coordinate = [](int i, int count) { return sqr(grid_coordinate(i, count)); };
  for_each_row(roughness_count, [&](int r) {
    const float alpha = glm::max(sqr(coordinate(r, roughness_count)), ggx_min_alpha);
    for (int c = 0; c < cosine_count; ++c) {
      const float cosine = glm::max(coordinate(c, cosine_count), 1e-4f);  // the limit of grazing incidence
      const Vec3 wo(safe_sqrt(1 - sqr(cosine)), 0, cosine);
      Value sum(0.0f);
      for (const Vec2 u : facet_samples) sum += value(wo, sample_ggx_visible(wo, alpha, u), alpha);
      values_[r][c] = sum / static_cast<float>(sample_count);
    }
    averages_[r] = Value(0.0f);
    for (int c = 0; c + 1 < cosine_count; ++c) {
      averages_[r] += cosine_weighted_integral(grid_coordinate(c, cosine_count), grid_coordinate(c + 1, cosine_count),
                                               values_[r][c], values_[r][c + 1]);
    }
  });
}

const GradedGgxAlbedo& GradedGgxAlbedo::shared() {
  static const GradedGgxAlbedo table;
  return table;
}

GradedGgxAlbedo::GradedGgxAlbedo() {
  grid_.fill([](Vec3 wo, Vec3 h, float alpha) {
    const float schlick = fresnel_schlick(Vec3(0), Vec3(1), glm::dot(wo, h)).x;
    return Vec2(1 - schlick, schlick) * reflected_share(wo, h, alpha);
  });
}

GradedDielectricAlbedo::GradedDielectricAlbedo(const DielectricRange& range)
    : range_(range),
      grids_(ior_count(range.least_ior, range.greatest_ior)),
      reshaped_(range.may_be_reshaped ? grids_.size() : 0) {
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const float fraction = grids_.size() > 1 ? static_cast<float>(i) / static_cast<float>(grids_.size() - 1) : 0.0f;
    const float ior = glm::mix(range.least_ior, range.greatest_ior, fraction);
    grids_[i].fill([ior, &range](Vec3 wo, Vec3 h, float alpha) {
      return Vec3(dielectric_energy(wo, h, alpha, ior, range.mean_ior), dielectric_energy(wo, h, alpha, 1 / ior),
                  range.may_be_coated ? energy_by_coat(wo, h, alpha, 1 / ior) : 0.0f);
    });
    if (!range.may_be_reshaped) continue;
    reshaped_[i].fill([ior, &range](Vec3 wo, Vec3 h, float alpha) {
      return glm::mat2x3(reshaped_by_facet(wo, h, alpha, ior, range.mean_ior, false),
                         reshaped_by_facet(wo, h, alpha, 1 / ior, 1 / ior, range.may_be_coated));
    });
  }
}

}  // namespace candil

#include "materials/anisotropy.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "core/sampler.h"
#include "materials/facet_energy.h"
#include "materials/grid_position.h"

namespace candil {
namespace {

constexpr std::uint32_t sample_count = 512;
const float least_roughness = std::sqrt(ggx_min_alpha);

/// Where `value` lies between `low` and `high`, which may be the same.
float coordinate_between(float low, float high, float value) {
  return high - low > 1e-6f ? (value - low) / (high - low) : 0.0f;
}

/// Perceptual roughnesses of a cell; the smaller one is along y.
Vec2 roughness_at(float coordinate_roughness, float coordinate_strength) {
  const float along_y = glm::mix(least_roughness, 1.0f, coordinate_roughness);
  return {glm::mix(along_y, 1.0f, coordinate_strength), along_y};
}

/// Coordinate of the slope of masking, which is alpha times the tangent: dense at both of its ends.
float slope_coordinate(float slope) { return 1 / (1 + glm::sqrt(slope)); }
float slope_at(float coordinate) { return sqr(1 / glm::max(coordinate, 1e-3f) - 1); }

Vec3 direction_at(Vec2 roughness, float coordinate_azimuth, float coordinate_slope) {
  const float projected = sqr(glm::mix(roughness.y, roughness.x, coordinate_azimuth));
  const Vec2 alpha = roughness * roughness;
  const float cos2 = glm::clamp(coordinate_between(sqr(alpha.y), sqr(alpha.x), sqr(projected)), 0.0f, 1.0f);
  const float tangent = slope_at(coordinate_slope) / projected;
  const float cosine = 1 / glm::sqrt(1 + sqr(tangent)), sine = tangent * cosine;
  return {sine * glm::sqrt(cos2), sine * glm::sqrt(1 - cos2), cosine};
}

}  // namespace

Vec2 anisotropic_alpha(float roughness, float strength) {
  const float alpha = sqr(roughness);
  return glm::max(Vec2(glm::mix(alpha, 1.0f, sqr(strength)), alpha), Vec2(ggx_min_alpha));
}

/// The four rows around a pair of roughnesses.
struct AnisotropicGrid::Rows {
  GridPosition roughness, strength;
  explicit Rows(Vec2 perceptual)
      : roughness(coordinate_between(least_roughness, 1, perceptual.y), roughness_count),
        strength(coordinate_between(perceptual.y, 1, perceptual.x), strength_count) {}

  template <typename Value>
  Vec2 interpolate(const Value& value) const {
    const auto along_strength = [&](int r) {
      return glm::mix(value(row(r, strength.index)), value(row(r, strength.index + 1)), strength.fraction);
    };
    return glm::mix(along_strength(roughness.index), along_strength(roughness.index + 1), roughness.fraction);
  }
};

template <typename Value>
void AnisotropicGrid::fill(const Value& value) {
  std::vector<Vec2> samples(sample_count);
  for (std::uint32_t i = 0; i < sample_count; ++i) samples[i] = Sampler({0, 0}, i, 0).sample_2d(0);
  values_.resize(row(roughness_count, 0) * azimuth_count * slope_count);
  averages_.resize(row(roughness_count, 0));
  tbb::parallel_for(0, roughness_count * strength_count, [&](int cell) {
    const Vec2 roughness = roughness_at(grid_coordinate(cell / strength_count, roughness_count),
                                        grid_coordinate(cell % strength_count, strength_count));
    const Vec2 alpha = roughness * roughness;
    Vec2* out = values_.data() + static_cast<std::size_t>(cell) * azimuth_count * slope_count;
    for (int a = 0; a < azimuth_count; ++a) {
      for (int s = 0; s < slope_count; ++s, ++out) {
        const Vec3 wo = direction_at(roughness, grid_coordinate(a, azimuth_count), grid_coordinate(s, slope_count));
        Vec2 sum(0);
        for (const Vec2 u : samples) sum += value(wo, sample_ggx_visible(wo, alpha, u), alpha);
        *out = sum / static_cast<float>(sample_count);
      }
    }
  });
  // The mean of what directional() returns, by midpoints in azimuth and squared cosine.
  constexpr int azimuths = 16, cosines = 64;
  tbb::parallel_for(0, roughness_count * strength_count, [&](int cell) {
    const Vec2 roughness = roughness_at(grid_coordinate(cell / strength_count, roughness_count),
                                        grid_coordinate(cell % strength_count, strength_count));
    Vec2 sum(0);
    for (int a = 0; a < azimuths; ++a) {
      const float phi = (static_cast<float>(a) + 0.5f) / azimuths * (0.5f * pi);
      for (int c = 0; c < cosines; ++c) {
        const float cos2 = (static_cast<float>(c) + 0.5f) / cosines, sine = glm::sqrt(1 - cos2);
        sum += directional(roughness * roughness, Vec3(sine * std::cos(phi), sine * std::sin(phi), glm::sqrt(cos2)));
      }
    }
    averages_[static_cast<std::size_t>(cell)] = sum / static_cast<float>(azimuths * cosines);
  });
}

Vec2 AnisotropicGrid::directional(Vec2 alpha, Vec3 w) const {
  const Vec2 perceptual = glm::sqrt(alpha);
  const float sin2 = sqr(w.x) + sqr(w.y);
  const float steepness = glm::sqrt(sqr(alpha.x * w.x) + sqr(alpha.y * w.y));  // projected alpha times the sine
  const float projected = sin2 > 0 ? steepness / glm::sqrt(sin2) : alpha.y;
  const Rows rows(perceptual);
  const GridPosition azimuth(coordinate_between(perceptual.y, perceptual.x, glm::sqrt(projected)), azimuth_count);
  const GridPosition slope(slope_coordinate(steepness / glm::max(glm::abs(w.z), 1e-6f)), slope_count);
  const std::size_t offset =
      static_cast<std::size_t>(azimuth.index) * slope_count + static_cast<std::size_t>(slope.index);
  return rows.interpolate([&](std::size_t cell) {
    const Vec2* v = values_.data() + cell * (azimuth_count * slope_count) + offset;
    return glm::mix(glm::mix(v[0], v[1], slope.fraction), glm::mix(v[slope_count], v[slope_count + 1], slope.fraction),
                    azimuth.fraction);
  });
}

Vec2 AnisotropicGrid::average(Vec2 alpha) const {
  return Rows(glm::sqrt(alpha)).interpolate([&](std::size_t cell) { return averages_[cell]; });
}

AnisotropicAlbedo::AnisotropicAlbedo() {
  grid_.fill([](Vec3 wo, Vec3 h, Vec2 alpha) { return Vec2(reflected_share(wo, h, alpha)); });
}

AnisotropicDielectricAlbedo::AnisotropicDielectricAlbedo(float ior) : ior_(ior) {
  grid_.fill([ior](Vec3 wo, Vec3 h, Vec2 alpha) {
    return Vec2(dielectric_energy(wo, h, alpha, ior), dielectric_energy(wo, h, alpha, 1 / ior));
  });
}

}  // namespace candil

/// Tables over the two roughnesses of an anisotropic interface and the direction, for anisotropy.h.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/math.h"
#include "materials/ggx.h"
#include "materials/grid_position.h"
#include "materials/table_rows.h"

namespace candil {

/// Grid points by perceptual roughness along y and, from that one to 1, along x.
template <int roughness_count, int strength_count>
struct AnisotropicRows {
  static constexpr int count = roughness_count * strength_count;

  /// Perceptual, of a row.
  static Vec2 roughness(int row) {
    const float along_y = glm::mix(least_roughness(), 1.0f, share(row / strength_count, roughness_count));
    return {glm::mix(along_y, 1.0f, share(row % strength_count, strength_count)), along_y};
  }

  /// The four rows around a pair of roughnesses, with their weights.
  struct Around {
    std::array<std::size_t, 4> row;
    std::array<float, 4> weight;
  };
  static Around around(Vec2 alpha) {
    const Vec2 perceptual = glm::sqrt(alpha);
    const float missing = 1 - perceptual.y;
    const GridPosition r(coordinate((perceptual.y - least_roughness()) / (1 - least_roughness())), roughness_count);
    const GridPosition s(missing > 1e-6f ? coordinate((perceptual.x - perceptual.y) / missing) : 0.0f, strength_count);
    Around result;
    for (int i = 0; i < 4; ++i) {
      const int along_y = i / 2, along_x = i % 2;
      result.row[i] =
          static_cast<std::size_t>(r.index + along_y) * strength_count + static_cast<std::size_t>(s.index + along_x);
      result.weight[i] = (along_y ? r.fraction : 1 - r.fraction) * (along_x ? s.fraction : 1 - s.fraction);
    }
    return result;
  }

 private:
  static float least_roughness() { return std::sqrt(ggx_min_alpha); }
  /// A little denser towards 0: x^2 / 4 + 3 x / 4, and its inverse.
  static float share(int index, int count) {
    const float x = grid_coordinate(index, count);
    return 0.25f * x * (3 + x);
  }
  static float coordinate(float share) { return glm::sqrt(glm::max(2.25f + 4 * share, 0.0f)) - 1.5f; }
};

/// Mean of `value(h)`, an array of numbers, over facet normals h that are visible from wo: points of a Fibonacci
/// lattice.
template <int sample_count, int previous_fibonacci_number, typename Value>
auto mean_over_facets(Vec3 wo, Vec2 alpha, const Value& value) {
  static const std::array<CapSample, sample_count> samples = [] {
    std::array<CapSample, sample_count> all;
    for (int i = 0; i < sample_count; ++i) {
      const int permuted = i * previous_fibonacci_number % sample_count;
      all[i] = CapSample(
          Vec2((static_cast<float>(i) + 0.5f) / sample_count, (static_cast<float>(permuted) + 0.5f) / sample_count));
    }
    return all;
  }();
  decltype(value(wo)) mean{};
  for (const CapSample& u : samples) {
    const auto one = value(sample_ggx_visible(wo, alpha, u));
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += one[k] * (1.0f / sample_count);
  }
  return mean;
}

/// `count` numbers over roughnesses and directions, linearly interpolated. Facets of a surface that is smooth along y
/// lie in the plane of x and z: the directions' coordinates are the angle with this plane, and the angle in it. Both
/// are dense towards grazing directions. Where light would be totally reflected by all such facets, or by none, the
/// table has a line of points.
template <int count, int roughness_count = 10, int strength_count = 8, int elevation_count = 16>
class AnisotropicGrid {
 public:
  using Values = std::array<float, count>;

  /// `eta`: index beyond the interface over the one before it.
  explicit AnisotropicGrid(float eta = 1) : critical_(eta < 1 ? std::asin(eta) : 0.0f) {}

  /// `values(wo, alpha)` of each grid point; called in parallel.
  template <typename Function>
  void fill(const Function& values) {
    values_.resize(static_cast<std::size_t>(Rows::count) * cell_count);
    for_each_row(Rows::count, [&](int row) {
      const Vec2 roughness = Rows::roughness(row), alpha = roughness * roughness;
      Values* out = values_.data() + static_cast<std::size_t>(row) * cell_count;
      for (int e = 0; e < elevation_count; ++e) {
        for (int a = 0; a < angle_count; ++a, ++out) *out = values(direction(e, a), alpha);
      }
    });
  }

  /// On either side of the surface.
  Values operator()(Vec2 alpha, Vec3 w) const {
    const typename Rows::Around rows = Rows::around(alpha);
    const float elevation = std::asin(glm::min(glm::abs(w.y), 1.0f));
    const float angle = std::atan2(glm::abs(w.x), glm::abs(w.z));
    const GridPosition e(elevation_coordinate(elevation), elevation_count);
    const GridPosition a(angle_coordinate(angle), angle_count);
    Values result{};
    for (int i = 0; i < 4; ++i) {
      const Values* cell = values_.data() + rows.row[i] * cell_count + e.index * angle_count + a.index;
      const float below = rows.weight[i] * (1 - e.fraction), above = rows.weight[i] * e.fraction;
      const std::array<float, 4> weights{below * (1 - a.fraction), below * a.fraction, above * (1 - a.fraction),
                                         above * a.fraction};
      for (int k = 0; k < count; ++k) {
        result[k] += weights[0] * cell[0][k] + weights[1] * cell[1][k] + weights[2] * cell[angle_count][k] +
                     weights[3] * cell[angle_count + 1][k];
      }
    }
    return result;
  }

 private:
  static constexpr int angle_count = 16, cell_count = elevation_count * angle_count;
  static constexpr float share_below = 0.6f;  // of coordinates, of elevations below the critical one
  static constexpr float right_angle = 0.5f * pi;
  using Rows = AnisotropicRows<roughness_count, strength_count>;

  static float angle_coordinate(float angle) { return 1 - glm::sqrt(glm::max(0.0f, 1 - angle / right_angle)); }
  float elevation_coordinate(float elevation) const {
    if (elevation < critical_) return share_below * (1 - glm::sqrt(1 - elevation / critical_));
    const float above = glm::min((elevation - critical_) / (right_angle - critical_), 1.0f);
    if (critical_ > 0) return share_below + (1 - share_below) * std::acos(1 - 2 * above) / pi;
    return 1 - glm::sqrt(1 - above);
  }
  /// The inverse of both.
  Vec3 direction(int elevation_index, int angle_index) const {
    const float e = grid_coordinate(elevation_index, elevation_count), a = grid_coordinate(angle_index, angle_count);
    const float angle = right_angle * (1 - sqr(1 - a));
    float elevation = right_angle * (1 - sqr(1 - e));
    if (critical_ > 0) {
      elevation = e < share_below ? critical_ * (1 - sqr(1 - e / share_below))
                                  : critical_ + (right_angle - critical_) * 0.5f *
                                                    (1 - std::cos(pi * (e - share_below) / (1 - share_below)));
    }
    const float in_plane = std::cos(elevation);
    const float z = glm::max(in_plane * std::cos(angle), 1e-3f);  // the limit of grazing incidence
    return glm::normalize(Vec3(in_plane * std::sin(angle), std::sin(elevation), z));
  }

  float critical_;  // elevation; 0: there is none
  std::vector<Values> values_;
};

/// Means of such functions over the cosine-weighted hemisphere, by roughness. `has_roots`: they are not negative, and
/// grow like the fourth power of the roughness; what is interpolated is their fourth roots.
template <int count, bool has_roots = false>
class AnisotropicMeans {
 public:
  using Values = std::array<float, count>;

  /// By midpoints of `values(alpha, w)`, called in parallel. They are dense at grazing angles and about the y axis,
  /// where facets of small roughness lose their light.
  template <typename Function>
  void fill(const Function& values) {
    constexpr int azimuths = 12, cosines = 40;
    means_.resize(Rows::count);
    for_each_row(Rows::count, [&](int row) {
      const Vec2 roughness = Rows::roughness(row);
      Values sum{};
      float weights = 0;
      for (int i = 0; i < azimuths * cosines; ++i) {
        const float u = (static_cast<float>(i / cosines) + 0.5f) / azimuths;
        const float v = (static_cast<float>(i % cosines) + 0.5f) / cosines;
        const float phi = 0.5f * pi * (1 - sqr(u)), cosine = sqr(v), sine = glm::sqrt(1 - sqr(cosine));
        const float weight = u * v * cosine;  // d(phi) cosine d(cosine)
        const Values one = values(roughness * roughness, Vec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
        for (int k = 0; k < count; ++k) sum[k] += weight * one[k];
        weights += weight;
      }
      for (float& mean : sum) mean = has_roots ? glm::sqrt(safe_sqrt(mean / weights)) : mean / weights;
      means_[static_cast<std::size_t>(row)] = sum;
    });
  }

  Values operator()(Vec2 alpha) const {
    const typename Rows::Around rows = Rows::around(alpha);
    Values result{};
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < count; ++k) result[k] += rows.weight[i] * means_[rows.row[i]][k];
    }
    if (has_roots) {
      for (float& root : result) root = sqr(sqr(root));
    }
    return result;
  }

 private:
  using Rows = AnisotropicRows<24, 24>;
  std::vector<Values> means_;
};

}  // namespace candil

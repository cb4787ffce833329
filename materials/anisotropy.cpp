#include "materials/anisotropy.h"

#include "materials/facet_energy.h"
#include "materials/table_rows.h"

namespace candil {
namespace {

/// Where `value` lies between `low` and `high`, which may be the same.
float coordinate_between(float low, float high, float value) {
  return high - low > 1e-6f ? (value - low) / (high - low) : 0.0f;
}

/// Coordinate of the slope of masking, which is alpha times the tangent: dense at both of its ends.
float slope_coordinate(float slope) { return 1 / (1 + glm::sqrt(slope)); }
float slope_at(float coordinate) { return sqr(1 / glm::max(coordinate, 1e-3f) - 1); }

/// `roughness`: perceptual.
Vec3 direction_at(Vec2 roughness, float coordinate_azimuth, float coordinate_slope) {
  const float projected = sqr(glm::mix(roughness.y, roughness.x, coordinate_azimuth));
  const Vec2 alpha = roughness * roughness;
  const float cos2 = glm::clamp(coordinate_between(sqr(alpha.y), sqr(alpha.x), sqr(projected)), 0.0f, 1.0f);
  const float tangent = slope_at(coordinate_slope) / projected;
  const float cosine = 1 / glm::sqrt(1 + sqr(tangent)), sine = tangent * cosine;
  return {sine * glm::sqrt(cos2), sine * glm::sqrt(1 - cos2), cosine};
}

/// What is met so rarely that its share of the total is arbitrary.
float divisor(float total) { return glm::max(total, 1e-5f); }

}  // namespace

Vec2 anisotropic_alpha(float roughness, float strength) {
  const float alpha = sqr(roughness);
  return glm::max(Vec2(glm::mix(alpha, 1.0f, sqr(strength)), alpha), Vec2(ggx_min_alpha));
}

const AnisotropicAlbedo& AnisotropicAlbedo::shared(bool has_films) {
  if (has_films) {
    static const AnisotropicAlbedo with_films(true);
    return with_films;
  }
  static const AnisotropicAlbedo without_films(false);
  return without_films;
}

AnisotropicAlbedo::AnisotropicAlbedo(bool has_films) {
  fill_totals();
  bias_.fill([](Vec3 wo, Vec2 alpha) -> std::array<float, 1> {
    const auto [reflected, bias] = mean_over_facets<256>(wo, alpha, [&](Vec3 h) {
      const float share = reflected_share(wo, h, alpha);
      return std::array{share, share * fresnel_schlick(Vec3(0), Vec3(1), glm::dot(wo, h)).x};
    });
    return {bias / divisor(reflected)};
  });
  averages_.fill([&](Vec2 alpha, Vec3 w) {
    const GgxAlbedo::Split split = directional(alpha, w);
    return std::array{split.total(), split.bias};
  });
  if (!has_films) return;
  nodes_ = std::make_unique<Nodes>();
  nodes_->shares.fill([](Vec3 wo, Vec2 alpha) {
    constexpr int count = FacetAngles::node_count;
    const auto sums = mean_over_facets<256>(wo, alpha, [&](Vec3 h) {
      std::array<float, count + 1> all;  // the last one is the total
      const float share = all[count] = reflected_share(wo, h, alpha);
      const float position = glm::dot(wo, h) * (count + 1) - 1;
      for (int i = 0; i < count; ++i) all[i] = share * glm::max(0.0f, 1 - glm::abs(position - static_cast<float>(i)));
      return all;
    });
    FacetAngles::Nodes shares;
    for (int i = 0; i < count; ++i) shares[i] = sums[i] / divisor(sums[count]);
    return shares;
  });
  nodes_->means.fill([&](Vec2 alpha, Vec3 w) { return directional_nodes(alpha, w); });
}

void AnisotropicAlbedo::fill_totals() {
  totals_.resize(static_cast<std::size_t>(Rows::count) * cell_count);
  for_each_row(Rows::count, [&](int row) {
    const Vec2 roughness = Rows::roughness(row), alpha = roughness * roughness;
    float* out = totals_.data() + static_cast<std::size_t>(row) * cell_count;
    for (int a = 0; a < azimuth_count; ++a) {
      for (int s = 0; s < slope_count; ++s, ++out) {
        const Vec3 wo = direction_at(roughness, grid_coordinate(a, azimuth_count), grid_coordinate(s, slope_count));
        *out = mean_over_facets<512>(wo, alpha, [&](Vec3 h) { return std::array{reflected_share(wo, h, alpha)}; })[0];
      }
    }
  });
}

float AnisotropicAlbedo::total(Vec2 alpha, Vec3 w) const {
  const Vec2 perceptual = glm::sqrt(alpha);
  const float sin2 = sqr(w.x) + sqr(w.y);
  const float steepness = glm::sqrt(sqr(alpha.x * w.x) + sqr(alpha.y * w.y));  // projected alpha times the sine
  const float projected = sin2 > 0 ? steepness / glm::sqrt(sin2) : alpha.y;
  const GridPosition azimuth(coordinate_between(perceptual.y, perceptual.x, glm::sqrt(projected)), azimuth_count);
  const GridPosition slope(slope_coordinate(steepness / glm::max(glm::abs(w.z), 1e-6f)), slope_count);
  const Rows::Around rows = Rows::around(alpha);
  float result = 0;
  for (int i = 0; i < 4; ++i) {
    const float* v = totals_.data() + rows.row[i] * cell_count + azimuth.index * slope_count + slope.index;
    result += rows.weight[i] * glm::mix(glm::mix(v[0], v[1], slope.fraction),
                                        glm::mix(v[slope_count], v[slope_count + 1], slope.fraction), azimuth.fraction);
  }
  return result;
}

GgxAlbedo::Split AnisotropicAlbedo::directional(Vec2 alpha, Vec3 w) const {
  const float all = total(alpha, w), bias = all * bias_(alpha, w)[0];
  return {all - bias, bias};
}

GgxAlbedo::Split AnisotropicAlbedo::average(Vec2 alpha) const {
  const auto [all, bias] = averages_(alpha);
  return {all - bias, bias};
}

FacetAngles::Nodes AnisotropicAlbedo::directional_nodes(Vec2 alpha, Vec3 w) const {
  FacetAngles::Nodes nodes = nodes_->shares(alpha, w);
  const float all = total(alpha, w);
  for (float& share : nodes) share *= all;
  return nodes;
}

AnisotropicDielectricAlbedo::AnisotropicDielectricAlbedo(float ior, bool has_films, const AnisotropicAlbedo& reflecting)
    : ior_(ior),
      reflecting_(&reflecting),
      sides_{Side(ior, false, has_films, reflecting), Side(1 / ior, true, has_films, reflecting)} {}

AnisotropicDielectricAlbedo::Side::Side(float eta, bool is_inside, bool has_films, const AnisotropicAlbedo& reflecting)
    : shares(eta) {
  shares.fill([eta](Vec3 wo, Vec2 alpha) -> std::array<float, 2> {
    const auto [lost_if_reflected, of_reflected, of_refracted] = mean_over_facets<512>(wo, alpha, [&](Vec3 h) {
      const float cosine = glm::max(0.0f, glm::dot(wo, h)), reflectance = fresnel_dielectric(cosine, eta);
      const float lost = 1 - reflected_share(wo, h, alpha);
      return std::array{lost, reflectance * lost,
                        reflectance < 1 ? (1 - reflectance) * (1 - refracted_share(wo, h, alpha, eta)) : 0.0f};
    });
    // From the denser side, facets refract grazing light back towards their own side: it is lost where hardly anything
    // that is reflected is.
    if (eta > 1) return {(of_reflected + of_refracted) / divisor(lost_if_reflected), 0.0f};
    return {of_reflected / divisor(lost_if_reflected), of_refracted};
  });
  mean_lost.fill([&](Vec2 alpha, Vec3 w) { return std::array{lost(alpha, w, reflecting)}; });
  if (!has_films) return;
  nodes = std::make_unique<Nodes>(Nodes{AnisotropicGrid<FilmedDielectricAlbedo::node_count, 6, 6>(eta), {}});
  nodes->directional.fill([&](Vec3 wo, Vec2 alpha) {
    return mean_over_facets<256>(
        wo, alpha, [&](Vec3 h) { return FilmedDielectricAlbedo::of_facet(wo, h, alpha, eta, is_inside); });
  });
  nodes->means.fill([&](Vec2 alpha, Vec3 w) { return nodes->directional(alpha, w); });
}

float AnisotropicDielectricAlbedo::Side::lost(Vec2 alpha, Vec3 w, const AnisotropicAlbedo& reflecting) const {
  const auto [factor, besides] = shares(alpha, w);
  return factor * glm::max(0.0f, 1 - reflecting.total(alpha, w)) + besides;
}

}  // namespace candil

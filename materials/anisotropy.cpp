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

/// Coordinate of where the projected roughness lies between the two: dense where facets are seen along their smooth
/// direction.
float azimuth_coordinate(float share) { return safe_sqrt(share); }
float azimuth_share(float coordinate) { return sqr(coordinate); }

/// `roughness`: perceptual.
Vec3 direction_at(Vec2 roughness, float coordinate_azimuth, float coordinate_slope) {
  const float projected = sqr(glm::mix(roughness.y, roughness.x, azimuth_share(coordinate_azimuth)));
  const Vec2 alpha = roughness * roughness;
  const float cos2 = glm::clamp(coordinate_between(sqr(alpha.y), sqr(alpha.x), sqr(projected)), 0.0f, 1.0f);
  const float tangent = slope_at(coordinate_slope) / projected;
  const float cosine = 1 / glm::sqrt(1 + sqr(tangent)), sine = tangent * cosine;
  return {sine * glm::sqrt(cos2), sine * glm::sqrt(1 - cos2), cosine};
}

/// Schlick's term at a facet as most are that are seen from w: along the surface, the cosine at facets is as great as
/// their roughness. What is left of the mean over facets is small and smooth.
float schlick_at_common_facet(Vec2 alpha, Vec3 w) {
  const float cosine = glm::sqrt(sqr(w.z) + 1.5f * (sqr(alpha.x * w.x) + sqr(alpha.y * w.y)));
  return fresnel_schlick(Vec3(0), Vec3(1), cosine).x;
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
    const auto [reflected, bias] = mean_over_facets<610, 377>(wo, alpha, [&](Vec3 h) {
      const float share = reflected_share(wo, h, alpha);
      return std::array{share, share * fresnel_schlick(Vec3(0), Vec3(1), glm::dot(wo, h)).x};
    });
    // What lies below a coat gets what it leaves over: a thousandth is for the errors of the table, so that they lose
    // energy rather than make it.
    return {bias / divisor(reflected) - schlick_at_common_facet(alpha, wo) + 1e-3f};
  });
  averages_.fill([&](Vec2 alpha, Vec3 w) {
    const GgxAlbedo::Split split = directional(alpha, w);
    return std::array{1 - split.total(), split.bias};
  });
  if (!has_films) return;
  nodes_ = std::make_unique<Nodes>();
  nodes_->shares.fill([](Vec3 wo, Vec2 alpha) {
    constexpr int count = FacetAngles::node_count;
    const auto sums = mean_over_facets<610, 377>(wo, alpha, [&](Vec3 h) {
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
  roots_.resize(static_cast<std::size_t>(Rows::count) * cell_count);
  for_each_row(Rows::count, [&](int row) {
    const Vec2 roughness = Rows::roughness(row), alpha = roughness * roughness;
    float* out = roots_.data() + static_cast<std::size_t>(row) * cell_count;
    for (int a = 0; a < azimuth_count; ++a) {
      for (int s = 0; s < slope_count; ++s, ++out) {
        const Vec3 wo = direction_at(roughness, grid_coordinate(a, azimuth_count), grid_coordinate(s, slope_count));
        const auto lost = [&](Vec3 h) { return std::array{1 - reflected_share(wo, h, alpha)}; };
        *out = glm::sqrt(mean_over_facets<987, 610>(wo, alpha, lost)[0]);
      }
    }
  });
}

float AnisotropicAlbedo::total(Vec2 alpha, Vec3 w) const {
  const Vec2 perceptual = glm::sqrt(alpha);
  const float sin2 = sqr(w.x) + sqr(w.y);
  const float steepness = glm::sqrt(sqr(alpha.x * w.x) + sqr(alpha.y * w.y));  // projected alpha times the sine
  const float projected = sin2 > 0 ? steepness / glm::sqrt(sin2) : alpha.y;
  const GridPosition azimuth(azimuth_coordinate(coordinate_between(perceptual.y, perceptual.x, glm::sqrt(projected))),
                             azimuth_count);
  const GridPosition slope(slope_coordinate(steepness / glm::max(glm::abs(w.z), 1e-6f)), slope_count);
  const Rows::Around rows = Rows::around(alpha);
  float root = 0;
  for (int i = 0; i < 4; ++i) {
    const float* v = roots_.data() + rows.row[i] * cell_count + azimuth.index * slope_count + slope.index;
    root += rows.weight[i] * glm::mix(glm::mix(v[0], v[1], slope.fraction),
                                      glm::mix(v[slope_count], v[slope_count + 1], slope.fraction), azimuth.fraction);
  }
  return 1 - sqr(root);
}

GgxAlbedo::Split AnisotropicAlbedo::directional(Vec2 alpha, Vec3 w) const {
  const float all = total(alpha, w), bias = all * (schlick_at_common_facet(alpha, w) + bias_(alpha, w)[0]);
  return {all - bias, bias};
}

GgxAlbedo::Split AnisotropicAlbedo::average(Vec2 alpha) const {
  const auto [lost, bias] = averages_(alpha);
  return {1 - lost - bias, bias};
}

FacetAngles::Nodes AnisotropicAlbedo::directional_nodes(Vec2 alpha, Vec3 w) const {
  FacetAngles::Nodes nodes = nodes_->shares(alpha, w);
  const float all = total(alpha, w);
  for (float& share : nodes) share *= all;
  return nodes;
}

AnisotropicDielectricAlbedo::AnisotropicDielectricAlbedo(float ior, bool has_films, bool may_be_reshaped,
                                                         const AnisotropicAlbedo& reflecting)
    : ior_(ior),
      reflecting_(&reflecting),
      sides_{Side(ior, has_films, may_be_reshaped, reflecting), Side(1 / ior, has_films, may_be_reshaped, reflecting)} {
}

AnisotropicDielectricAlbedo::Side::Side(float eta, bool has_films, bool may_be_reshaped,
                                        const AnisotropicAlbedo& reflecting)
    : shares(eta) {
  shares.fill([eta](Vec3 wo, Vec2 alpha) -> std::array<float, 2> {
    const auto [lost_if_reflected, of_reflected, of_refracted] = mean_over_facets<610, 377>(wo, alpha, [&](Vec3 h) {
      const float cosine = glm::max(0.0f, glm::dot(wo, h)), reflectance = fresnel_dielectric(cosine, eta);
      const float lost = 1 - reflected_share(wo, h, alpha);
      return std::array{lost, reflectance * lost,
                        reflectance < 1 ? (1 - reflectance) * (1 - refracted_share(wo, h, alpha, eta)) : 0.0f};
    });
    // From the denser side, facets refract grazing light back towards their own side: it is lost where hardly anything
    // that is reflected is.
    if (eta > 1) return {glm::sqrt((of_reflected + of_refracted) / divisor(lost_if_reflected)), 0.0f};
    return {glm::sqrt(of_reflected / divisor(lost_if_reflected)), glm::sqrt(of_refracted)};
  });
  mean_lost.fill([&](Vec2 alpha, Vec3 w) { return std::array{lost(alpha, w, reflecting)}; });
  if (may_be_reshaped) {
    reshaped = std::make_unique<Reshaped>(Reshaped{AnisotropicGrid<2, 18, 10, 21>(eta), {}});
    reshaped->directional.fill([&](Vec3 wo, Vec2 alpha) {
      return mean_over_facets<377, 233>(wo, alpha, [&](Vec3 h) -> std::array<float, 2> {
        const float less_kept = less_kept_by_reflecting(wo, h, alpha, eta);
        return {less_kept, less_kept * fresnel_dielectric(glm::max(0.0f, glm::dot(wo, h)), eta)};
      });
    });
    reshaped->means.fill([&](Vec2 alpha, Vec3 w) { return reshaped->directional(alpha, w); });
  }
  if (!has_films) return;
  nodes = std::make_unique<Nodes>(Nodes{AnisotropicGrid<FilmedDielectricAlbedo::node_count, 6, 6>(eta), {}});
  nodes->directional.fill([&](Vec3 wo, Vec2 alpha) {
    return mean_over_facets<610, 377>(wo, alpha,
                                      [&](Vec3 h) { return FilmedDielectricAlbedo::of_facet(wo, h, alpha, eta); });
  });
  nodes->means.fill([&](Vec2 alpha, Vec3 w) { return nodes->directional(alpha, w); });
}

float AnisotropicDielectricAlbedo::Side::lost(Vec2 alpha, Vec3 w, const AnisotropicAlbedo& reflecting) const {
  // Two thousandths are for the errors of the tables, so that they lose energy rather than make it.
  constexpr float margin = 2e-3f;
  const auto [factor, besides] = shares(alpha, w);
  return glm::max(0.0f, sqr(factor) * glm::max(0.0f, 1 - reflecting.total(alpha, w)) + sqr(besides) - margin);
}

}  // namespace candil

#include "materials/ggx_albedo.h"

#include "core/sampler.h"
#include "materials/facet_energy.h"
#include "materials/grid_position.h"
#include "materials/table_rows.h"

namespace candil {
namespace {

constexpr int roughness_count = AlbedoGrid::roughness_count, cosine_count = AlbedoGrid::cosine_count;
constexpr std::uint32_t sample_count = 512;

Vec3 direction_of_cosine(float cosine) {
  const float z = glm::max(cosine, 1e-4f);  // the limit of grazing incidence
  return {safe_sqrt(1 - sqr(z)), 0, z};
}

/// Mean of `value(wo, h, alpha)` over visible facet normals h.
template <typename Value>
auto integrate(float roughness, float cosine, const Value& value) {
  const Vec3 wo = direction_of_cosine(cosine);
  const float alpha = glm::max(sqr(roughness), ggx_min_alpha);
  decltype(value(wo, wo, alpha)) sum{};
  for (std::uint32_t i = 0; i < sample_count; ++i) {
    const Vec2 u = Sampler({0, 0}, i, 0).sample_2d(0);
    sum += value(wo, sample_ggx_visible(wo, alpha, u), alpha);
  }
  return sum * (1.0f / sample_count);
}

/// 2 * integral of mu * row(mu), exactly for the interpolant of the row.
float cosine_weighted_mean(const std::array<float, cosine_count>& row) {
  float sum = 0;
  for (int i = 0; i + 1 < cosine_count; ++i) {
    sum += cosine_weighted_integral(grid_coordinate(i, cosine_count), grid_coordinate(i + 1, cosine_count), row[i],
                                    row[i + 1]);
  }
  return sum;
}

template <typename Function>
void for_each_cell(const Function& function) {
  for_each_row(roughness_count, [&](int r) {
    for (int c = 0; c < cosine_count; ++c) {
      function(r, c, sqr(grid_coordinate(r, roughness_count)), sqr(grid_coordinate(c, cosine_count)));
    }
  });
}

}  // namespace

float AlbedoGrid::lookup(const Position& position) const {
  const auto& [r, c] = position;
  const auto row = [&, column = c](int index) {
    return glm::mix(values[index][column.index], values[index][column.index + 1], column.fraction);
  };
  return glm::mix(row(r.index), row(r.index + 1), r.fraction);
}

const GgxAlbedo& GgxAlbedo::shared() {
  static const GgxAlbedo table;
  return table;
}

GgxAlbedo::GgxAlbedo() {
  for_each_cell([&](int r, int c, float roughness, float cosine) {
    const Vec2 split = integrate(roughness, cosine, [](Vec3 wo, Vec3 h, float alpha) {
      const float schlick = fresnel_schlick(Vec3(0), Vec3(1), glm::dot(wo, h)).x;
      return Vec2(1 - schlick, schlick) * reflected_share(wo, h, alpha);
    });
    scale_.values[r][c] = split.x;
    bias_.values[r][c] = split.y;
  });
  for (int r = 0; r < roughness_count; ++r) {
    average_[r] = {cosine_weighted_mean(scale_.values[r]), cosine_weighted_mean(bias_.values[r])};
  }
}

GgxAlbedo::Split GgxAlbedo::average(float roughness) const {
  const GridPosition r = AlbedoGrid::roughness_position(roughness);
  const Split &low = average_[r.index], &high = average_[r.index + 1];
  return {glm::mix(low.scale, high.scale, r.fraction), glm::mix(low.bias, high.bias, r.fraction)};
}

FacetAngles::FacetAngles() {
  using Sums = glm::mat2x4;  // eight numbers that can be added up
  static_assert(node_count == 8);
  for_each_cell([&](int r, int c, float roughness, float cosine) {
    const Sums sums = integrate(roughness, cosine, [](Vec3 wo, Vec3 h, float alpha) {
      Sums shares(0);
      const float share = reflected_share(wo, h, alpha), position = glm::dot(wo, h) * (node_count + 1) - 1;
      for (int node = 0; node < node_count; ++node) {
        shares[node / 4][node % 4] = share * glm::max(0.0f, 1 - glm::abs(position - static_cast<float>(node)));
      }
      return shares;
    });
    for (int node = 0; node < node_count; ++node) grids_[node].values[r][c] = sums[node / 4][node % 4];
  });
  for (int node = 0; node < node_count; ++node) {
    for (int r = 0; r < roughness_count; ++r) averages_[node][r] = cosine_weighted_mean(grids_[node].values[r]);
  }
}

FacetAngles::Nodes FacetAngles::directional(float roughness, float cosine) const {
  const AlbedoGrid::Position position(roughness, cosine);
  Nodes nodes;
  for (int node = 0; node < node_count; ++node) nodes[node] = grids_[node].lookup(position);
  return nodes;
}

FacetAngles::Nodes FacetAngles::average(float roughness) const {
  const GridPosition r = AlbedoGrid::roughness_position(roughness);
  Nodes nodes;
  for (int node = 0; node < node_count; ++node) {
    nodes[node] = glm::mix(averages_[node][r.index], averages_[node][r.index + 1], r.fraction);
  }
  return nodes;
}

DielectricAlbedo::DielectricAlbedo(float ior) : ior_(ior) {
  for (const bool inside : {false, true}) {
    const float eta = inside ? 1 / ior : ior;
    AlbedoGrid& grid = sides_[inside];
    for_each_cell([&](int r, int c, float roughness, float cosine) {
      grid.values[r][c] = integrate(
          roughness, cosine, [eta](Vec3 wo, Vec3 h, float alpha) { return dielectric_energy(wo, h, alpha, eta); });
    });
    for (int r = 0; r < roughness_count; ++r) averages_[inside][r] = cosine_weighted_mean(grid.values[r]);
  }
}

float DielectricAlbedo::average(float roughness, bool from_inside) const {
  const GridPosition r = AlbedoGrid::roughness_position(roughness);
  return glm::mix(averages_[from_inside][r.index], averages_[from_inside][r.index + 1], r.fraction);
}

template <typename Alpha>
FilmedDielectricAlbedo::Nodes FilmedDielectricAlbedo::of_facet(Vec3 wo, Vec3 h, Alpha alpha, float eta) {
  Nodes nodes{};
  const float less_kept = less_kept_by_reflecting(wo, h, alpha, eta);
  if (less_kept == 0) return nodes;
  const float cosine = glm::dot(wo, h);
  const float position = (eta < 1 ? glm::sqrt(1 - (1 - sqr(cosine)) / sqr(eta)) : cosine) * node_count - 1;
  for (int node = 0; node < node_count; ++node) {
    nodes[node] = less_kept * glm::max(0.0f, 1 - glm::abs(position - static_cast<float>(node)));
  }
  return nodes;
}
template FilmedDielectricAlbedo::Nodes FilmedDielectricAlbedo::of_facet(Vec3, Vec3, Vec2, float);

FilmedDielectricAlbedo::FilmedDielectricAlbedo(float ior) : ior_(ior) {
  for (const bool inside : {false, true}) {
    for_each_cell([&](int r, int c, float roughness, float cosine) {
      using Sums = glm::mat2x4;  // eight numbers that can be added up
      static_assert(node_count == 8);
      const Sums sums = integrate(roughness, cosine, [&](Vec3 wo, Vec3 h, float alpha) {
        const Nodes nodes = of_facet(wo, h, alpha, inside ? 1 / ior : ior);
        Sums all;
        for (int node = 0; node < node_count; ++node) all[node / 4][node % 4] = nodes[node];
        return all;
      });
      for (int node = 0; node < node_count; ++node) sides_[inside][node].values[r][c] = sums[node / 4][node % 4];
    });
    for (int node = 0; node < node_count; ++node) {
      for (int r = 0; r < roughness_count; ++r) {
        averages_[inside][node][r] = cosine_weighted_mean(sides_[inside][node].values[r]);
      }
    }
  }
}

FilmedDielectricAlbedo::Nodes FilmedDielectricAlbedo::directional(float roughness, float cosine,
                                                                  bool from_inside) const {
  const AlbedoGrid::Position position(roughness, cosine);
  Nodes nodes;
  for (int node = 0; node < node_count; ++node) nodes[node] = sides_[from_inside][node].lookup(position);
  return nodes;
}

FilmedDielectricAlbedo::Nodes FilmedDielectricAlbedo::average(float roughness, bool from_inside) const {
  const GridPosition r = AlbedoGrid::roughness_position(roughness);
  Nodes nodes;
  for (int node = 0; node < node_count; ++node) {
    const auto& averages = averages_[from_inside][node];
    nodes[node] = glm::mix(averages[r.index], averages[r.index + 1], r.fraction);
  }
  return nodes;
}

}  // namespace candil

#include "materials/sheen_albedo.h"

#include <cmath>

#include "materials/table_rows.h"

namespace candil {
namespace {

/// Points of the table lie where the albedo changes fast: close for small roughness and cosines.
struct GridAxis {
  int count;
  float from;
  float power;

  float value(int index) const {
    return glm::mix(from, 1.0f, std::pow(static_cast<float>(index) / static_cast<float>(count - 1), power));
  }
  /// Fractional index, in [0, count - 1].
  float position(float value) const {
    const float t = glm::clamp((value - from) / (1 - from), 0.0f, 1.0f);
    return std::pow(t, 1 / power) * static_cast<float>(count - 1);
  }
};

GridAxis roughness_axis(int count) { return {count, Charlie::min_roughness, 2}; }
GridAxis cosine_axis(int count) { return {count, 0, 3}; }

constexpr int nodes = 32;

struct Node {
  float cosine, sine, weight;  // weight: d(cosine)
  float lambda;
};

std::array<Node, nodes> make_nodes(float alpha) {
  std::array<Node, nodes> made;
  for (int i = 0; i < nodes; ++i) {
    // Midpoints in t, cosine = t^3: most of the sheen is near the horizon.
    const float t = (static_cast<float>(i) + 0.5f) / nodes;
    const float cosine = t * t * t;
    made[i] = {cosine, glm::sqrt(1 - sqr(cosine)), 3 * sqr(t) / nodes, Charlie::lambda(cosine, alpha)};
  }
  return made;
}

/// Integral of f cos over the hemisphere by midpoints.
float integrate(float cosine_o, float alpha, const std::array<Node, nodes>& nodes_i) {
  const float z = Charlie::bounded(cosine_o), sine = glm::sqrt(glm::max(0.0f, 1 - sqr(z)));
  const float lambda = Charlie::lambda(z, alpha);
  float sum = 0;
  for (const Node& i : nodes_i) {
    float ring = 0;  // mean of the distribution over azimuth
    for (int k = 0; k < nodes; ++k) {
      const float phi = pi * (static_cast<float>(k) + 0.5f) / nodes;
      const float cosine_between = z * i.cosine + sine * i.sine * std::cos(phi);
      const float cosine2_half = sqr(z + i.cosine) / (2 + 2 * cosine_between);
      ring += Charlie::distribution(1 - cosine2_half, alpha) / nodes;
    }
    sum += i.weight * ring / ((1 + lambda + i.lambda) * 4 * z);
  }
  return 2 * pi * sum;
}

}  // namespace

float Charlie::distribution(float sine2, float alpha) {
  return (2 + 1 / alpha) * std::pow(glm::max(sine2, 0.0f), 0.5f / alpha) / (2 * pi);
}

float Charlie::lambda(float cosine, float alpha) {
  const float t = sqr(1 - alpha);
  const float a = glm::mix(21.5473f, 25.3245f, t), b = glm::mix(3.82987f, 3.32435f, t);
  const float c = glm::mix(0.19823f, 0.16801f, t), d = glm::mix(-1.97760f, -1.27393f, t);
  const float e = glm::mix(-4.32054f, -4.85967f, t);
  const auto l = [&](float x) { return a / (1 + b * std::pow(x, c)) + d * x + e; };
  return std::exp(cosine < 0.5f ? l(cosine) : 2 * l(0.5f) - l(glm::max(1 - cosine, 0.0f)));
}

SheenAlbedo::SheenAlbedo() {
  for_each_row(roughness_count, [&](int r) {
    const float alpha = sqr(roughness_axis(roughness_count).value(r));
    const std::array<Node, nodes> nodes_i = make_nodes(alpha);
    for (int c = 0; c < cosine_count; ++c) {
      values_[r][c] = integrate(cosine_axis(cosine_count).value(c), alpha, nodes_i);
    }
  });
}

float SheenAlbedo::directional(float roughness, float cosine) const {
  const float r = roughness_axis(roughness_count).position(roughness);
  const float c = cosine_axis(cosine_count).position(cosine);
  const int row = glm::min(static_cast<int>(r), roughness_count - 2);
  const int column = glm::min(static_cast<int>(c), cosine_count - 2);
  const float u = r - static_cast<float>(row), v = c - static_cast<float>(column);
  const auto at = [&](int i) { return glm::mix(values_[i][column], values_[i][column + 1], v); };
  return glm::mix(at(row), at(row + 1), u);
}

}  // namespace candil

/// Real renders beside bare replays of their rays.
#pragma once

#include <array>
#include <vector>

#include "bench/contest.h"

namespace candil {

/// Times renders of a scene. The context outlives it.
class RenderTimes {
 public:
  RenderTimes(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
              std::size_t thread_counts);

  /// Renders once; `thread_index` counts the numbers of threads.
  void measure(std::size_t thread_index, int threads);

  /// `ray_seconds`: how long a ray takes in a bare replay, in each repetition.
  RenderOverhead overhead(std::size_t thread_index, const PerRayKind<std::vector<double>>& ray_seconds) const;

 private:
  /// Paths of that many scattering events: none, one, as many as the settings allow.
  static constexpr std::size_t depth_count = 3;
  using Seconds = std::array<std::vector<double>, depth_count>;

  RenderContext context_;
  Camera camera_;
  std::array<RenderSettings, depth_count> settings_;
  std::array<RayCounts, depth_count> rays_;
  std::vector<Seconds> seconds_;  // for each number of threads
};

}  // namespace candil

#include "bench/render_times.h"

#include <algorithm>

namespace candil {
namespace {

double to_double(std::uint64_t count) { return static_cast<double>(count); }

/// Ratio of the medians, 0 if nothing can be said.
double share(const std::vector<double>& part, const std::vector<double>& whole) {
  const double median = spread_of(whole).median;
  return median > 0 ? spread_of(part).median / median : 0;
}

}  // namespace

RenderTimes::RenderTimes(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
                         std::size_t thread_counts)
    : context_(context), camera_(camera), seconds_(thread_counts) {
  settings_.fill(settings);
  settings_[0].max_bounces = 0;
  settings_[1].max_bounces = std::min(1u, settings.max_bounces);
}

void RenderTimes::measure(std::size_t thread_index, int threads) {
  for (std::size_t depth = 0; depth < depth_count; ++depth) {
    settings_[depth].threads = threads;
    const RenderResult result = render(context_, camera_, settings_[depth]);
    rays_[depth] = result.rays;
    seconds_[thread_index][depth].push_back(result.seconds);
  }
}

RenderOverhead RenderTimes::overhead(std::size_t thread_index,
                                     const PerRayKind<std::vector<double>>& ray_seconds) const {
  const Seconds& seconds = seconds_[thread_index];
  const RayCounts &none = rays_[0], &one = rays_[1], &all = rays_[2];
  std::vector<double> rays, samples, total, primary, replay_first, replay_deeper, render_first, render_deeper;
  for (std::size_t i = 0; i < seconds[0].size(); ++i) {
    const double shadow = ray_seconds[RayKind::shadow][i];
    const double of_primary = to_double(none.camera) * ray_seconds[RayKind::primary][i];
    const double of_first =
        to_double(one.bounce) * ray_seconds[RayKind::first_bounce][i] + to_double(one.shadow) * shadow;
    const double of_deeper = to_double(all.bounce - one.bounce) * ray_seconds[RayKind::deeper_bounces][i] +
                             to_double(all.shadow - one.shadow) * shadow;
    rays.push_back(to_double(all.total()) / seconds[2][i]);
    samples.push_back(to_double(all.camera) / seconds[2][i]);
    total.push_back((of_primary + of_first + of_deeper) / seconds[2][i]);
    primary.push_back(of_primary / seconds[0][i]);
    replay_first.push_back(of_first), render_first.push_back(seconds[1][i] - seconds[0][i]);
    replay_deeper.push_back(of_deeper), render_deeper.push_back(seconds[2][i] - seconds[1][i]);
  }
  RenderOverhead result;
  result.rays_per_second = spread_of(rays);
  result.samples_per_second = spread_of(samples);
  result.total = spread_of(total);
  result.primary = spread_of(primary);
  result.first_bounce = share(replay_first, render_first);
  result.deeper = share(replay_deeper, render_deeper);
  return result;
}

}  // namespace candil

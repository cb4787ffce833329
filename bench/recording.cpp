#include "bench/recording.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "core/denormals.h"
#include "integrators/camera_sampling.h"

namespace candil {
namespace {

/// So many paths go through a vertex together in path.cpp: its rays come in this order.
constexpr std::size_t paths_at_once = 16;

struct Shot {
  Ray ray;
  RayKind kind;
  std::uint32_t vertex;  // of the path that it starts from; the camera is 0
};

/// Passes every ray on and keeps a copy. It knows what a ray is for because it is used for one path at a time: the
/// first ray that looks for a hit is the camera's, and each further one leaves the next surface.
class Recorder final : public Accelerator {
 public:
  explicit Recorder(const Accelerator& inner) : inner_(inner) {}

  void begin_path() { vertex_ = 0; }
  /// What was shot since take() was called last.
  std::vector<Shot>& shots() { return shots_; }

  std::optional<Hit> intersect(const Ray& ray) const override {
    const RayKind kind = vertex_ == 0   ? RayKind::primary
                         : vertex_ == 1 ? RayKind::first_bounce
                                        : RayKind::deeper_bounces;
    shots_.push_back({ray, kind, vertex_++});
    return inner_.intersect(ray);
  }
  bool occluded(const Ray& ray) const override {
    shots_.push_back({ray, RayKind::shadow, vertex_});
    return inner_.occluded(ray);
  }
  std::size_t memory_bytes() const override { return inner_.memory_bytes(); }

 private:
  const Accelerator& inner_;
  mutable std::vector<Shot> shots_;
  mutable std::uint32_t vertex_ = 0;
};

class RecordingJob {
 public:
  RecordingJob(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
               std::size_t max_bytes)
      : recorder_(context.accelerator),
        context_{context.scene, recorder_, context.lights, context.tables},
        settings_(settings),
        camera_(camera, settings),
        max_rays_(max_bytes / sizeof(Ray)) {
    result_.paths_wanted = std::uint64_t{settings.samples_per_pixel} * static_cast<std::uint64_t>(settings.width) *
                           static_cast<std::uint64_t>(settings.height);
  }

  Recording run() {
    const DenormalsAreZero denormals_are_zero;
    std::uint32_t done = 0;
    while (done < settings_.samples_per_pixel && !is_full_) {
      const std::uint32_t samples = next_block_size(done, settings_.samples_per_pixel);
      record_block(done, samples);
      done += samples;
    }
    for (const RayKind kind : ray_kinds) result_.rays[kind].shrink_to_fit();
    return std::move(result_);
  }

 private:
  /// Tile after tile as render() goes, but in an order that soon has been everywhere: what fits is a fair choice.
  void record_block(std::uint32_t first_sample, std::uint32_t samples) {
    const int columns = (settings_.width + tile_size - 1) / tile_size;
    const int rows = (settings_.height + tile_size - 1) / tile_size;
    const std::uint64_t count = std::uint64_t(columns) * std::uint64_t(rows);
    std::uint64_t step = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(0.618034 * static_cast<double>(count)));
    while (std::gcd(step, count) != 1) ++step;
    for (std::uint64_t i = 0; i < count && !is_full_; ++i) {
      const auto tile = static_cast<int>(i * step % count);
      record_tile(tile % columns * tile_size, tile / columns * tile_size, first_sample, samples);
    }
  }

  /// Row by row, like render().
  void record_tile(int left, int top, std::uint32_t first_sample, std::uint32_t samples) {
    std::vector<CameraSample> starts;
    for (int y = top; y < std::min(top + tile_size, settings_.height) && !is_full_; ++y) {
      camera_.sample({left, std::min(left + tile_size, settings_.width), y}, first_sample, samples, starts);
      for (std::size_t first = 0; first < starts.size() && !is_full_; first += paths_at_once)
        record_paths(std::span(starts).subspan(first, std::min(paths_at_once, starts.size() - first)));
    }
  }

  void record_paths(std::span<const CameraSample> starts) {
    RayCounts counts;
    std::vector<Shot>& shots = recorder_.shots();
    shots.clear();
    for (const CameraSample& start : starts) {
      recorder_.begin_path();
      trace_path(context_, settings_, start.ray, start.sampler, counts);
    }
    if (result_.ray_count() + shots.size() > max_rays_) {
      is_full_ = true;
      return;
    }
    std::ranges::stable_sort(shots, {}, &Shot::vertex);
    for (const Shot& shot : shots) result_.rays[shot.kind].push_back(shot.ray);
    result_.paths += starts.size();
  }

  Recorder recorder_;
  const RenderContext context_;
  const RenderSettings& settings_;
  const CameraSampling camera_;
  const std::size_t max_rays_;
  bool is_full_ = false;
  Recording result_;
};

}  // namespace

const char* ray_kind_name(RayKind kind) {
  switch (kind) {
    case RayKind::primary:
      return "primary";
    case RayKind::first_bounce:
      return "first bounce";
    case RayKind::deeper_bounces:
      return "deeper bounces";
    case RayKind::shadow:
      return "shadow";
  }
  return "";
}

std::size_t Recording::ray_count() const {
  std::size_t count = 0;
  for (const RayKind kind : ray_kinds) count += rays[kind].size();
  return count;
}

Recording record_rays(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
                      std::size_t max_bytes) {
  return RecordingJob(context, camera, settings, max_bytes).run();
}

}  // namespace candil

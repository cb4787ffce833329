#include "integrators/render.h"

#include <tbb/blocked_range2d.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <mutex>
#include <span>

#include "core/denormals.h"
#include "integrators/aov_film.h"
#include "integrators/camera_sampling.h"

namespace candil {
namespace {

constexpr double progress_interval_seconds = 0.2;

struct Block {
  std::uint32_t first_sample, samples;
};

/// One render under way. Threads work on tiles of a block of samples; whatever they count is integers, so that the
/// order in which tiles end does not matter.
class RenderJob {
 public:
  RenderJob(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
            const std::function<void(const RenderProgress&)>& on_progress, const std::atomic<bool>* stop)
      : context_(context),
        settings_(settings),
        camera_(camera, settings),
        trace_(integrator_function(settings.integrator)),
        on_progress_(on_progress),
        stop_(stop),
        film_(settings.width, settings.height) {
    if (!settings.aovs.empty()) aov_film_.emplace(context, camera, settings);
  }

  RenderResult run() {
    const std::uint32_t wanted = settings_.samples_per_pixel;
    while (film_.sample_count() < wanted) {
      // The first block always ends, so that there is a picture to write.
      if (film_.sample_count() > 0 && (is_stopped() || is_out_of_time())) break;
      const Block block{film_.sample_count(), next_block_size(film_.sample_count(), wanted)};
      film_.begin_block();
      if (aov_film_) aov_film_->begin_block();
      tiles_done_ = 0;
      render_block(block);
      if (is_cancelled_) {
        film_.drop_block();
        if (aov_film_) aov_film_->drop_block();
        break;
      }
      film_.end_block(block.samples);
      if (aov_film_) aov_film_->end_block(block.samples);
      report(0, block.samples);
    }
    RenderResult result{
        std::move(film_), {camera_rays_, bounce_rays_, shadow_rays_, aov_rays_}, non_finite_, seconds()};
    if (aov_film_) result.aovs = aov_film_->layers();
    const bool is_complete = result.film.sample_count() == wanted;
    result.was_interrupted = !is_complete && is_stopped();
    result.was_out_of_time = !is_complete && !result.was_interrupted;
    return result;
  }

 private:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool is_stopped() const { return stop_ && stop_->load(std::memory_order_relaxed); }
  bool is_out_of_time() const { return settings_.time_limit_seconds > 0 && seconds() >= settings_.time_limit_seconds; }

  void render_block(const Block& block) {
    using Tiles = tbb::blocked_range2d<int>;
    const Tiles image(0, settings_.height, tile_size, 0, settings_.width, tile_size);
    tbb::parallel_for(
        image,
        [&](const Tiles& tile) {
          if (block.first_sample > 0 && (is_cancelled_ || is_stopped() || is_out_of_time())) {
            is_cancelled_ = true;
            return;
          }
          render_tile(tile, block);
          tiles_done_ += static_cast<std::int64_t>(tile.rows().size()) * static_cast<std::int64_t>(tile.cols().size());
          report_sometimes(block);
        },
        tbb::simple_partitioner());
  }

  /// Gives the film the samples of a pixel's block; answers how many were not finite.
  std::uint64_t add_pixel(int x, int y, std::span<const PathSample> samples) {
    std::uint64_t non_finite = 0;
    PairwiseSum<PixelSums> sum;
    for (PathSample sample : samples) {
      if (!is_finite(sample.radiance)) {
        ++non_finite;
        sample.radiance = Vec3(0);
      }
      sum.add({sample.radiance, sample.alpha, sample.radiance * sample.radiance});
    }
    film_.block_pixel(x, y) = sum.total();
    return non_finite;
  }

  void render_tile(const tbb::blocked_range2d<int>& tile, const Block& block) {
    const DenormalsAreZero denormals_are_zero;
    RayCounts rays;
    std::uint64_t non_finite = 0;
    // A row at a time: its samples stay in the cache.
    std::vector<CameraSample> samples;
    std::vector<PathSample> results(tile.cols().size() * block.samples);
    samples.reserve(results.size());
    for (int y = tile.rows().begin(); y < tile.rows().end(); ++y) {
      camera_.sample({tile.cols().begin(), tile.cols().end(), y}, block.first_sample, block.samples, samples);
      trace_(context_, settings_, samples, results, rays);
      for (int x = tile.cols().begin(); x < tile.cols().end(); ++x) {
        const std::size_t first = static_cast<std::size_t>(x - tile.cols().begin()) * block.samples;
        non_finite += add_pixel(x, y, std::span(results).subspan(first, block.samples));
        if (aov_film_) {
          const auto of_pixel = std::span(samples).subspan(first, block.samples);
          aov_film_->add_pixel(x, y, of_pixel, block.first_sample == 0, rays);
        }
      }
    }
    camera_rays_ += rays.camera;
    bounce_rays_ += rays.bounce;
    shadow_rays_ += rays.shadow;
    aov_rays_ += rays.aov;
    non_finite_ += non_finite;
  }

  void report_sometimes(const Block& block) {
    if (!on_progress_) return;
    const std::unique_lock lock(progress_mutex_, std::try_to_lock);
    if (!lock || seconds() - last_report_ < progress_interval_seconds) return;
    report(tiles_done_, block.samples);
  }

  /// `pixels` of the block under way are done; 0 right after a block.
  void report(std::int64_t pixels, std::uint32_t block_samples) {
    if (!on_progress_) return;
    if (pixels == 0) relative_noise_ = film_.relative_noise();
    const double pixel_count = static_cast<double>(settings_.width) * settings_.height;
    const double samples = film_.sample_count() + block_samples * static_cast<double>(pixels) / pixel_count;
    RenderProgress progress;
    progress.samples_done = film_.sample_count();
    progress.samples_wanted = settings_.samples_per_pixel;
    progress.fraction_done = samples / settings_.samples_per_pixel;
    progress.seconds = last_report_ = seconds();
    progress.samples_per_second = progress.seconds > 0 ? samples * pixel_count / progress.seconds : 0;
    progress.relative_noise = relative_noise_;
    on_progress_(progress);
  }

  const RenderContext& context_;
  const RenderSettings& settings_;
  const CameraSampling camera_;
  const BatchIntegrator trace_;
  const std::function<void(const RenderProgress&)>& on_progress_;
  const std::atomic<bool>* stop_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  Film film_;
  std::optional<AovFilm> aov_film_;
  std::atomic<bool> is_cancelled_{false};
  std::atomic<std::int64_t> tiles_done_{0};
  std::atomic<std::uint64_t> camera_rays_{0}, bounce_rays_{0}, shadow_rays_{0}, aov_rays_{0}, non_finite_{0};
  std::mutex progress_mutex_;
  double last_report_ = 0;
  float relative_noise_ = 0;
};

}  // namespace

RenderResult render(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
                    const std::function<void(const RenderProgress&)>& on_progress, const std::atomic<bool>* stop) {
  const int threads = settings.threads > 0 ? settings.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  std::optional<RenderResult> result;
  arena.execute([&] { result.emplace(RenderJob(context, camera, settings, on_progress, stop).run()); });
  return std::move(*result);
}

}  // namespace candil

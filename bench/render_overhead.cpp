// How close a render comes to the limit: rays per second of whole renders beside two replays of exactly the rays that
// they shot, one through our accelerator and one straight through Embree. Prints the median of several interleaved
// rounds, so that drift of the machine cancels.
//   render_overhead SCENE [SAMPLES_PER_PIXEL [ROUNDS]]
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <vector>

#include "bench/bare_embree.h"
#include "core/camera.h"
#include "core/studio.h"
#include "integrators/render.h"
#include "io/load_scene.h"
#include "materials/alpha.h"

namespace {

using namespace candil;

/// Rays of one thread in the order in which it shot them.
struct Recording {
  std::vector<Ray> rays;
  std::vector<bool> is_shadow;
};

/// Passes every ray on and keeps a copy. For one thread.
class Recorder final : public Accelerator {
 public:
  explicit Recorder(const Accelerator& inner) : inner_(inner) {}
  std::optional<Hit> intersect(const Ray& ray) const override {
    keep(ray, false);
    return inner_.intersect(ray);
  }
  bool occluded(const Ray& ray) const override {
    keep(ray, true);
    return inner_.occluded(ray);
  }
  std::size_t memory_bytes() const override { return inner_.memory_bytes(); }
  const Recording& recording() const { return recording_; }

 private:
  void keep(const Ray& ray, bool is_shadow) const {
    recording_.rays.push_back(ray);
    recording_.is_shadow.push_back(is_shadow);
  }
  const Accelerator& inner_;
  mutable Recording recording_;
};

double seconds_of(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Calls `shoot(first, end)` for parts of the recording on that many threads; it answers how many rays hit, which keeps
/// the compiler from leaving them out.
std::uint64_t replay(const Recording& recording, int threads, const auto& shoot) {
  std::atomic<std::uint64_t> hits{0};
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, recording.rays.size(), 1 << 14),
                      [&](const auto& range) { hits += shoot(range.begin(), range.end()); });
  });
  return hits;
}

/// Part of a recording through the accelerator.
std::uint64_t shoot(const Accelerator& accelerator, const Recording& recording, std::size_t i, std::size_t end) {
  std::uint64_t found = 0;
  std::array<Hit, 64> answers;
  while (i < end) {
    if (recording.is_shadow[i]) {
      found += accelerator.occluded(recording.rays[i++]);
      continue;
    }
    std::size_t count = 1;
    while (count < answers.size() && i + count < end && !recording.is_shadow[i + count]) ++count;
    accelerator.intersect_each({&recording.rays[i], count}, answers);
    for (std::size_t k = 0; k < count; ++k) found += !answers[k].is_miss();
    i += count;
  }
  return found;
}

/// Seconds of each round.
struct Times {
  std::vector<double> render, replay, bare;
};

/// Median over the rounds of one time divided by the other.
double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median(ratios);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: render_overhead SCENE [SAMPLES_PER_PIXEL [ROUNDS]]\n");
    return 2;
  }
  try {
    Scene scene = load_scene(argv[1]).scene;
    if (!has_light(scene)) scene.environment = make_studio_environment();
    const auto accelerator = make_accelerator(scene, alpha_filter());
    const LightSampler lights(scene);
    const BsdfTables tables(scene);
    RenderSettings settings;
    settings.width = settings.height = 256;
    settings.samples_per_pixel = argc > 2 ? static_cast<std::uint32_t>(std::atoi(argv[2])) : 16;
    settings.filter = FilterKind::box;
    const int rounds = argc > 3 ? std::atoi(argv[3]) : 5;
    const Camera camera = scene.cameras.empty() ? frame_points(scene_outline(scene), 0.6f, 0.35f, 1) : scene.cameras[0];

    const Recorder recorder(*accelerator);
    settings.threads = 1;
    render({scene, recorder, lights, tables}, camera, settings);
    const auto ray_count = static_cast<double>(recorder.recording().rays.size());

    const std::optional<BareEmbree> bare = BareEmbree::make(scene);
    const Recording& recording = recorder.recording();
    const auto shoot_replay = [&](std::size_t first, std::size_t end) {
      return shoot(*accelerator, recording, first, end);
    };
    const auto shoot_bare = [&](std::size_t first, std::size_t end) {
      return bare->shoot(std::span(recording.rays).subspan(first, end - first), recording.is_shadow, first);
    };
    std::array<Times, 2> times;  // of 1 and 2 threads, in turn
    for (int round = 0; round < rounds; ++round) {
      for (const int threads : {1, 2}) {
        settings.threads = threads;
        Times& t = times[threads - 1];
        std::uint64_t hits = 0;
        t.render.push_back(seconds_of([&] { render({scene, *accelerator, lights, tables}, camera, settings); }));
        t.replay.push_back(seconds_of([&] { hits += replay(recording, threads, shoot_replay); }));
        if (bare) t.bare.push_back(seconds_of([&] { hits += replay(recording, threads, shoot_bare); }));
        if (hits == 0) std::printf("nothing was hit\n");
      }
    }
    for (const int threads : {1, 2}) {
      const Times& t = times[threads - 1];
      const double render_time = median(t.render);
      std::printf("%d thread%s: render %.2f Mrays/s (%.2f Msamples/s); replay %.2f Mrays/s, ratio %.3f", threads,
                  threads > 1 ? "s" : "", ray_count / render_time / 1e6,
                  65536.0 * settings.samples_per_pixel / render_time / 1e6, ray_count / median(t.replay) / 1e6,
                  median_ratio(t.replay, t.render));
      if (bare)
        std::printf("; bare Embree %.2f Mrays/s, ratio %.3f", ray_count / median(t.bare) / 1e6,
                    median_ratio(t.bare, t.render));
      std::printf("\n");
    }
    std::printf("2 threads render %.2f times as fast as 1\n", median_ratio(times[0].render, times[1].render));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 3;
  }
}

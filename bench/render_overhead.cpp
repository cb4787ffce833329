// How close a render comes to the limit that the accelerator sets: rays per second of whole renders beside a bare
// replay of exactly the rays that they shot. Prints the median of several interleaved rounds, so that drift of the
// machine cancels.
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

/// Shoots the recorded rays again and nothing else; the result keeps the compiler from leaving them out.
std::uint64_t replay(const Accelerator& accelerator, const Recording& recording, int threads) {
  std::atomic<std::uint64_t> hits{0};
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, recording.rays.size(), 1 << 14), [&](const auto& range) {
      std::uint64_t found = 0;
      std::array<Hit, 64> answers;
      for (std::size_t i = range.begin(); i < range.end();) {
        if (recording.is_shadow[i]) {
          found += accelerator.occluded(recording.rays[i++]);
          continue;
        }
        std::size_t count = 1;
        while (count < answers.size() && i + count < range.end() && !recording.is_shadow[i + count]) ++count;
        accelerator.intersect_each({&recording.rays[i], count}, answers);
        for (std::size_t k = 0; k < count; ++k) found += !answers[k].is_miss();
        i += count;
      }
      hits += found;
    });
  });
  return hits;
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
    const auto accelerator = make_embree_accelerator(scene, alpha_filter());
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

    double one_thread = 0;
    for (const int threads : {1, 2}) {
      settings.threads = threads;
      std::vector<double> rendering, replaying, ratios;
      std::uint64_t hits = 0;
      for (int round = 0; round < rounds; ++round) {
        rendering.push_back(seconds_of([&] { render({scene, *accelerator, lights, tables}, camera, settings); }));
        replaying.push_back(seconds_of([&] { hits += replay(*accelerator, recorder.recording(), threads); }));
        ratios.push_back(replaying.back() / rendering.back());
      }
      std::printf(
          "%d thread%s: render %.2f Mrays/s (%.2f Msamples/s), bare replay %.2f Mrays/s, ratio %.3f (%llu hits)\n",
          threads, threads > 1 ? "s" : "", ray_count / median(rendering) / 1e6,
          65536.0 * settings.samples_per_pixel / median(rendering) / 1e6, ray_count / median(replaying) / 1e6,
          median(ratios), static_cast<unsigned long long>(hits));
      if (threads == 1)
        one_thread = median(rendering);
      else
        std::printf("2 threads render %.2f times as fast as 1\n", one_thread / median(rendering));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 3;
  }
}

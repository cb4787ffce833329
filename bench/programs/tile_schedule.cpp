// Which thread renders which tile of a picture, and when, for figure 18 of the gallery: as JSON on standard output.
// The renderer itself keeps no such record. An accelerator in between sees every ray; those that start at the camera
// tell the pixel, and so the tile, that their thread is at.
//   tile_schedule SCENE [SIZE]
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/camera.h"
#include "integrators/render.h"
#include "io/load_scene.h"
#include "materials/alpha.h"

namespace {

using namespace candil;
using Clock = std::chrono::steady_clock;

/// Of one block of samples. In a square of a power of two pixels all tiles are whole.
constexpr int rays_per_tile = tile_size * tile_size;

/// Finds the pixel that a ray of a pinhole camera goes through.
class PixelFinder {
 public:
  PixelFinder(const Camera& camera, int size) : size_(size) {
    const CameraRays rays(camera, size, size);
    const auto s = static_cast<float>(size);
    const Ray middle = rays.ray({s / 2, s / 2}, {0.5f, 0.5f});
    origin_ = middle.origin, forward_ = middle.direction;
    corner_ = on_plane(rays.ray({0, 0}, {0.5f, 0.5f}).direction);
    right_ = on_plane(rays.ray({s, 0}, {0.5f, 0.5f}).direction) - corner_;
    down_ = on_plane(rays.ray({0, s}, {0.5f, 0.5f}).direction) - corner_;
  }
  bool is_from_camera(const Ray& ray) const { return ray.origin == origin_; }
  Vec2 pixel(const Ray& ray) const {
    const Vec3 offset = on_plane(ray.direction) - corner_;
    return static_cast<float>(size_) *
           Vec2(glm::dot(offset, right_) / glm::dot(right_, right_), glm::dot(offset, down_) / glm::dot(down_, down_));
  }

 private:
  Vec3 on_plane(Vec3 direction) const { return direction / glm::dot(direction, forward_); }

  int size_;
  Vec3 origin_, forward_, corner_, right_, down_;
};

/// The work of one thread on one tile.
struct Visit {
  Vec2 pixel_sum{0.0f};
  int camera_rays = 0;
  Clock::time_point begin, end;
};

class Recorder final : public Accelerator {
 public:
  Recorder(const Accelerator& inner, const PixelFinder& finder) : inner_(inner), finder_(finder) {}

  std::optional<Hit> intersect(const Ray& ray) const override {
    keep({&ray, 1});
    return inner_.intersect(ray);
  }
  void intersect_each(std::span<const Ray> rays, std::span<Hit> hits) const override {
    keep(rays);
    inner_.intersect_each(rays, hits);
  }
  bool occluded(const Ray& ray) const override {
    keep({&ray, 1});
    return inner_.occluded(ray);
  }
  std::size_t memory_bytes() const override { return inner_.memory_bytes(); }

  const auto& visits_by_thread() const { return visits_; }

 private:
  void keep(std::span<const Ray> rays) const {
    std::vector<Visit>& visits = visits_.local();
    const Clock::time_point now = Clock::now();
    for (const Ray& ray : rays) {
      if (!finder_.is_from_camera(ray)) continue;
      if (visits.empty() || visits.back().camera_rays == rays_per_tile) visits.emplace_back().begin = now;
      visits.back().pixel_sum += finder_.pixel(ray);
      ++visits.back().camera_rays;
    }
    if (!visits.empty()) visits.back().end = now;
  }

  const Accelerator& inner_;
  const PixelFinder& finder_;
  mutable tbb::enumerable_thread_specific<std::vector<Visit>> visits_;
};

/// Prints the later half of all visits: those of the second of two blocks of samples. By then all threads are awake.
void print(const Recorder& recorder, int size) {
  std::vector<Clock::time_point> begins;
  for (const std::vector<Visit>& visits : recorder.visits_by_thread()) {
    for (const Visit& visit : visits) begins.push_back(visit.begin);
  }
  std::sort(begins.begin(), begins.end());
  const Clock::time_point start = begins[begins.size() / 2];
  const auto milliseconds = [&](Clock::time_point time) {
    return std::chrono::duration<double, std::milli>(time - start).count();
  };
  std::printf("{\"size\": %d, \"tile_size\": %d, \"tiles\": [", size, tile_size);
  int thread = 0;
  const char* separator = "";
  for (const std::vector<Visit>& visits : recorder.visits_by_thread()) {
    for (const Visit& visit : visits) {
      if (visit.begin < start) continue;
      // The mean over all pixels of a tile is its middle: no ray at an edge can be taken for the neighbour's.
      const auto tile = glm::ivec2(visit.pixel_sum / static_cast<float>(visit.camera_rays * tile_size));
      std::printf("%s\n  {\"x\": %d, \"y\": %d, \"thread\": %d, \"begin_ms\": %.3f, \"end_ms\": %.3f}", separator,
                  tile.x * tile_size, tile.y * tile_size, thread, milliseconds(visit.begin), milliseconds(visit.end));
      separator = ",";
    }
    ++thread;
  }
  std::printf("\n]}\n");
}

}  // namespace

int main(int argc, char** argv) {
  const int size = argc == 3 ? std::atoi(argv[2]) : 256;
  if (argc < 2 || argc > 3 || size < tile_size || size > 4096 || !std::has_single_bit(static_cast<unsigned>(size))) {
    std::fprintf(stderr, "usage: tile_schedule SCENE [SIZE]\nSIZE: pixels, a power of two from %d to 4096\n",
                 tile_size);
    return 2;
  }
  try {
    const Scene scene = load_scene(argv[1]).scene;
    if (scene.cameras.empty() || scene.cameras[0].lens_radius > 0 || scene.cameras[0].kind != CameraKind::perspective) {
      std::fprintf(stderr, "error: %s: no pinhole camera\n", argv[1]);
      return 3;
    }
    const auto accelerator = make_accelerator(scene, alpha_filter());
    const LightSampler lights(scene);
    const BsdfTables tables(scene);
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.samples_per_pixel = 2;  // two blocks of one
    settings.filter = FilterKind::box;
    const PixelFinder finder(scene.cameras[0], size);
    const Recorder recorder(*accelerator, finder);
    render({scene, recorder, lights, tables}, scene.cameras[0], settings);
    print(recorder, size);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 3;
  }
}

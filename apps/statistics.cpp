#include "apps/statistics.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "apps/versions.h"
#include "io/atomic_file.h"
#include "io/image_file.h"

namespace candil {
namespace {

using Json = nlohmann::ordered_json;

std::uint64_t peak_memory_bytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

Json describe_rays(const RayCounts& rays) {
  return {{"camera", rays.camera},
          {"bounce", rays.bounce},
          {"shadow", rays.shadow},
          {"aov", rays.aov},
          {"total", rays.total()}};
}

Json describe_scene(const Scene& scene) {
  std::size_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
  return {{"meshes", scene.meshes.size()},
          {"instances", scene.instances.size()},
          {"triangles", triangles},
          {"instanced_triangles", instanced_triangle_count(scene)},
          {"materials", scene.materials.size()},
          {"images", scene.images.size()}};
}

}  // namespace

void write_statistics(const std::filesystem::path& path, const Scene& scene, const RenderSettings& settings,
                      const RenderResult& result, const RenderTimes& times, std::size_t bvh_bytes) {
  const std::uint32_t spp = result.film.sample_count();
  const double rays_per_second = result.seconds > 0 ? static_cast<double>(result.rays.total()) / result.seconds : 0;
  Json json;
  json["load_seconds"] = times.load;
  json["bvh_seconds"] = times.bvh;
  json["render_seconds"] = result.seconds;
  json["width"] = settings.width;
  json["height"] = settings.height;
  json["spp"] = spp;
  json["samples"] = std::uint64_t{spp} * settings.width * settings.height;
  json["relative_noise"] = result.film.relative_noise();
  json["non_finite_samples"] = result.non_finite_samples;
  json["rays"] = describe_rays(result.rays);
  json["rays_per_second"] = rays_per_second;
  json["interrupted"] = result.was_interrupted;
  json["out_of_time"] = result.was_out_of_time;
  json["seed"] = settings.seed;
  json["threads"] = settings.threads;
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["bvh_memory_bytes"] = bvh_bytes;
  json["scene"] = describe_scene(scene);
  json["versions"] = {
      {"candil", candil_version()}, {"embree", embree_version()}, {"openimageio", openimageio_version()}};
  write_file_atomically(path, json.dump(2) + "\n");
}

}  // namespace candil

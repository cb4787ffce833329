/// From a scene to pixels: the settings, the parallel loop over tiles, and what it counted.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "core/accelerator.h"
#include "core/film.h"
#include "core/light_sampler.h"
#include "core/pixel_filter.h"
#include "core/scene.h"
#include "integrators/aov.h"
#include "materials/bsdf_tables.h"

namespace candil {

/// Side of the largest tile, pixels. The picture is halved until parts are no larger.
inline constexpr int tile_size = 16;

enum class IntegratorKind { path, naive, classic, normals, albedo };

/// "path", "naive", "classic", "normals", "albedo"; nothing for any other name.
std::optional<IntegratorKind> integrator_from_name(std::string_view name);

struct RenderSettings {
  int width = 1024, height = 1024;  ///< Pixels, at least 1 each.
  std::uint32_t samples_per_pixel = 64;
  std::uint32_t max_bounces = 64;  ///< Scattering events of a path; 0 shows only what emits.
  std::uint64_t seed = 0;
  IntegratorKind integrator = IntegratorKind::path;
  bool transparent_background =
      false;  ///< Camera rays that hit nothing give black with alpha 0 instead of the environment.
  FilterKind filter = FilterKind::blackman_harris;
  std::vector<Aov> aovs;          ///< Made beside the picture, in this order; none cost nothing.
  int threads = 0;                ///< 0: all cores.
  double time_limit_seconds = 0;  ///< 0: none. The samples finished by then make the picture.
};

/// Rays by what they were shot for.
struct RayCounts {
  std::uint64_t camera = 0, bounce = 0, shadow = 0;
  std::uint64_t aov = 0;  ///< Camera rays shot once more for AOVs.
  std::uint64_t total() const { return camera + bounce + shadow + aov; }
};

struct RenderProgress {
  std::uint32_t samples_done = 0, samples_wanted = 0;  ///< Per pixel.
  double fraction_done = 0;                            ///< Of all tiles of all blocks, 0 to 1.
  double seconds = 0;
  double samples_per_second = 0;  ///< Pixel samples (camera paths) over the whole render so far.
  float relative_noise = 0;       ///< Film::relative_noise() after the last block; 0: not known yet.
};

struct RenderResult {
  Film film;
  RayCounts rays;
  std::uint64_t non_finite_samples = 0;  ///< Their radiance was NaN or infinite; they count as black.
  double seconds = 0;
  bool was_interrupted = false;  ///< `stop` became true before all samples were done.
  bool was_out_of_time = false;
  std::vector<ImageLayer> aovs = {};  ///< RenderSettings::aovs, of the samples that the film has.
};

/// Everything a path may ask of the scene. All of it outlives the render and is only read.
struct RenderContext {
  const Scene& scene;
  const Accelerator& accelerator;
  const LightSampler& lights;
  const BsdfTables& tables;
};

/// Renders with `camera`. Same arguments, same bits, for any number of threads. `on_progress` is called from one thread
/// at a time, a few times a second at the most. `stop` and the time limit are looked at between tiles: the block of
/// samples under way is then dropped, except the first one (one sample per pixel), which is always finished.
RenderResult render(const RenderContext& context, const Camera& camera, const RenderSettings& settings,
                    const std::function<void(const RenderProgress&)>& on_progress = {},
                    const std::atomic<bool>* stop = nullptr);

}  // namespace candil

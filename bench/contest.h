/// Accelerators side by side: the same rays of the same scene, checked, then timed in turns.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/agreement.h"
#include "bench/recording.h"
#include "bench/spread.h"
#include "core/accelerator.h"

namespace candil {

struct Contestant {
  std::string name;
  std::function<std::unique_ptr<Accelerator>(const Scene&)> make;
};

/// One that make_accelerator() knows, with the renderer's hit filter.
Contestant make_contestant(const std::string& name, const AcceleratorOptions& options);

struct ContestSettings {
  std::vector<int> threads = {1};     ///< Everything is timed with each of these numbers of threads.
  int repetitions = 5;                ///< At least 1.
  double longest_replay_seconds = 2;  ///< Of the rays of one kind, once; who is slower replays a fair choice of them.
};

/// How fast rays of one kind are.
struct RayRate {
  std::size_t rays = 0;    ///< That are replayed each time.
  Spread rays_per_second;  ///< Over the repetitions.
  Spread ratio;            ///< Divided by that of the first contestant in the same repetition.
};

struct ContestantResult {
  std::string name;
  std::size_t memory_bytes = 0;              ///< As it says itself.
  std::optional<double> bytes_per_instance;  ///< What a further instance costs; none without instancing.
  std::vector<Spread> build_seconds;         ///< For each number of threads.
  PerRayKind<Agreement> agreement;           ///< With the first contestant.
  std::vector<PerRayKind<RayRate>> rates;    ///< For each number of threads.
};

/// What the renderer makes of the first contestant, as parts of what the bare replay of the same rays would take: 1 is
/// a renderer that costs nothing. Each ratio is of one repetition. A render is three renders here, that of what emits,
/// that of one bounce, and the whole: their differences tell what each depth costs. Shadow rays count as much as those
/// of the recording on the average. Differences of short times are worth little: those that are not positive are told
/// as 0.
struct RenderOverhead {
  Spread rays_per_second;  ///< In the whole render.
  Spread samples_per_second;
  Spread total;             ///< Replay time over render time.
  Spread primary;           ///< Of camera rays alone, film and sampler included.
  double first_bounce = 0;  ///< Of the rays of the first bounce, and the shadow rays of the surfaces that they leave;
                            ///< ratio of medians.
  double deeper = 0;        ///< Of all further ones; likewise.
  Spread bare_total;  ///< `total`, but beside Embree asked directly (bench/bare_embree.h); zero if that cannot be.
};

struct ContestResult {
  PerRayKind<std::size_t> rays;  ///< That were recorded.
  std::uint64_t paths = 0, paths_wanted = 0;
  std::size_t recorded_bytes = 0;
  std::vector<ContestantResult> contestants;     ///< In the order in which they were given.
  std::vector<PerRayKind<RayRate>> bare_embree;  ///< For each number of threads, or empty.
  std::vector<RenderOverhead> overhead;          ///< For each number of threads.

  bool has_mismatch() const;
};

/// Called with what is being done.
using ContestProgress = std::function<void(const std::string&)>;

/// Records the rays of a render (see record_rays()) and lets the contestants, at least one, have at them. All are held
/// in memory at once. Throws what make() throws.
ContestResult run_contest(const Scene& scene, const Camera& camera, const RenderSettings& render,
                          std::size_t recording_bytes, const std::vector<Contestant>& contestants,
                          const ContestSettings& settings, const ContestProgress& progress = {});

}  // namespace candil

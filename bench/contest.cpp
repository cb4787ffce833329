#include "bench/contest.h"

#include <algorithm>

#include "bench/bare_embree.h"
#include "bench/instance_memory.h"
#include "bench/render_times.h"
#include "bench/replay.h"
#include "materials/alpha.h"

namespace candil {
namespace {

/// Seconds of one contestant's replays of one kind, in the order of the repetitions.
struct Track {
  RayChoice choice;
  Shoot shoot;
  std::vector<std::vector<double>> seconds;  // for each number of threads

  double rays() const { return static_cast<double>(choice.ray_count()); }
  std::vector<double> rates(std::size_t thread_index) const {
    std::vector<double> result;
    for (const double s : seconds[thread_index]) result.push_back(rays() / s);
    return result;
  }
};

class Contest {
 public:
  Contest(const Scene& scene, const std::vector<Contestant>& contestants, const ContestSettings& settings,
          const ContestProgress& progress)
      : scene_(scene), contestants_(contestants), settings_(settings), progress_(progress) {
    for (const Contestant& contestant : contestants) result_.contestants.emplace_back().name = contestant.name;
  }

  ContestResult run(const Camera& camera, const RenderSettings& render, std::size_t recording_bytes) {
    build();
    measure_memory();
    const LightSampler lights(scene_);
    const BsdfTables tables(scene_);
    const RenderContext context{scene_, *accelerators_.front(), lights, tables};
    say("recording rays");
    recording_ = record_rays(context, camera, render, recording_bytes);
    result_.paths = recording_.paths, result_.paths_wanted = recording_.paths_wanted;
    result_.recorded_bytes = recording_.bytes();
    for (const RayKind kind : ray_kinds) result_.rays[kind] = recording_.rays[kind].size();
    choose();
    check();
    RenderTimes renders(context, camera, render, settings_.threads.size());
    time(renders);
    summarize(renders);
    return std::move(result_);
  }

 private:
  void say(const std::string& text) const {
    if (progress_) progress_(text);
  }

  std::string count(int repetition) const {
    return std::to_string(repetition + 1) + " of " + std::to_string(settings_.repetitions);
  }

  /// In turns, each time beginning with another one.
  template <typename Work>
  void take_turns(int repetition, const Work& work) const {
    for (std::size_t i = 0; i < contestants_.size(); ++i)
      work((i + static_cast<std::size_t>(repetition)) % contestants_.size());
  }

  /// Slow builds are not repeated for ever.
  double longest_builds() const { return 5 * settings_.longest_replay_seconds; }

  void build() {
    const std::size_t thread_counts = settings_.threads.size();
    std::vector<std::vector<std::vector<double>>> seconds(contestants_.size(),
                                                          std::vector<std::vector<double>>(thread_counts));
    std::vector<double> spent(contestants_.size(), 0);
    accelerators_.resize(contestants_.size());
    for (int repetition = 0; repetition < settings_.repetitions; ++repetition) {
      say("building, " + count(repetition));
      take_turns(repetition, [&](std::size_t c) {
        if (repetition > 0 && spent[c] > longest_builds()) return;
        for (std::size_t t = 0; t < thread_counts; ++t) {
          accelerators_[c].reset();
          double taken = 0;
          on_threads(settings_.threads[t],
                     [&] { taken = seconds_of([&] { accelerators_[c] = contestants_[c].make(scene_); }); });
          seconds[c][t].push_back(taken);
          spent[c] += taken;
        }
      });
    }
    for (std::size_t c = 0; c < contestants_.size(); ++c)
      for (std::vector<double>& times : seconds[c]) result_.contestants[c].build_seconds.push_back(spread_of(times));
  }

  void measure_memory() {
    for (std::size_t c = 0; c < contestants_.size(); ++c) {
      result_.contestants[c].memory_bytes = accelerators_[c]->memory_bytes();
      result_.contestants[c].bytes_per_instance = bytes_per_instance(scene_, *accelerators_[c], contestants_[c].make);
    }
  }

  Track make_track(RayKind kind, const Shoot& shoot) const {
    const std::vector<Ray>& rays = recording_.rays[kind];
    return {choose_rays(rays, settings_.longest_replay_seconds, settings_.threads.front(), shoot), shoot,
            std::vector<std::vector<double>>(settings_.threads.size())};
  }

  void choose() {
    say("warming up");
    tracks_.resize(contestants_.size());
    for (std::size_t c = 0; c < contestants_.size(); ++c)
      for (const RayKind kind : ray_kinds) tracks_[c][kind] = make_track(kind, shoot_through(*accelerators_[c], kind));
    bare_embree_ = BareEmbree::make(scene_);
    if (!bare_embree_) return;
    for (const RayKind kind : ray_kinds) {
      bare_tracks_[kind] =
          make_track(kind, [this, kind](std::span<const Ray> rays) { return bare_embree_->shoot(rays, kind); });
    }
  }

  void check() {
    const int threads = *std::ranges::max_element(settings_.threads);
    for (std::size_t c = 1; c < contestants_.size(); ++c) {
      say("comparing the answers of " + contestants_[c].name);
      for (const RayKind kind : ray_kinds) {
        result_.contestants[c].agreement[kind] =
            compare(scene_, *accelerators_.front(), *accelerators_[c], tracks_[c][kind].choice, kind, threads);
      }
    }
  }

  void time(RenderTimes& renders) {
    for (int repetition = 0; repetition < settings_.repetitions; ++repetition) {
      say("replaying, " + count(repetition));
      for (std::size_t t = 0; t < settings_.threads.size(); ++t) {
        for (const RayKind kind : ray_kinds) {
          take_turns(repetition, [&](std::size_t c) { time(tracks_[c][kind], t); });
          if (bare_embree_) time(bare_tracks_[kind], t);
        }
        renders.measure(t, settings_.threads[t]);
      }
    }
  }

  void time(Track& track, std::size_t t) const {
    if (track.choice.rays.empty()) return;
    track.seconds[t].push_back(replay(track.choice, settings_.threads[t], track.shoot).seconds);
  }

  RayRate rate(const Track& track, const Track& first, std::size_t t) const {
    const std::vector<double> rates = track.rates(t);
    return {track.choice.ray_count(), spread_of(rates), spread_of_ratios(rates, first.rates(t))};
  }

  void summarize(const RenderTimes& renders) {
    for (std::size_t t = 0; t < settings_.threads.size(); ++t) {
      for (std::size_t c = 0; c < contestants_.size(); ++c) {
        PerRayKind<RayRate>& rates = result_.contestants[c].rates.emplace_back();
        for (const RayKind kind : ray_kinds) rates[kind] = rate(tracks_[c][kind], tracks_.front()[kind], t);
      }
      result_.overhead.push_back(renders.overhead(t, ray_seconds(tracks_.front(), t)));
      if (!bare_embree_) continue;
      PerRayKind<RayRate>& rates = result_.bare_embree.emplace_back();
      for (const RayKind kind : ray_kinds) rates[kind] = rate(bare_tracks_[kind], tracks_.front()[kind], t);
      result_.overhead.back().bare_total = renders.overhead(t, ray_seconds(bare_tracks_, t)).total;
    }
  }

  /// Seconds for one ray of each kind, in each repetition.
  PerRayKind<std::vector<double>> ray_seconds(const PerRayKind<Track>& tracks, std::size_t t) const {
    PerRayKind<std::vector<double>> result;
    for (const RayKind kind : ray_kinds) {
      for (const double seconds : tracks[kind].seconds[t]) result[kind].push_back(seconds / tracks[kind].rays());
      result[kind].resize(static_cast<std::size_t>(settings_.repetitions), 0);  // there are no such rays
    }
    return result;
  }

  const Scene& scene_;
  const std::vector<Contestant>& contestants_;
  const ContestSettings& settings_;
  const ContestProgress& progress_;
  std::vector<std::unique_ptr<Accelerator>> accelerators_;
  Recording recording_;
  std::vector<PerRayKind<Track>> tracks_;  // of each contestant
  std::optional<BareEmbree> bare_embree_;
  PerRayKind<Track> bare_tracks_;
  ContestResult result_;
};

}  // namespace

Contestant make_contestant(const std::string& name, const AcceleratorOptions& options) {
  return {name, [options](const Scene& scene) { return make_accelerator(scene, alpha_filter(), options); }};
}

bool ContestResult::has_mismatch() const {
  return std::ranges::any_of(contestants, [](const ContestantResult& contestant) {
    return std::ranges::any_of(ray_kinds, [&](RayKind kind) { return contestant.agreement[kind].mismatches > 0; });
  });
}

ContestResult run_contest(const Scene& scene, const Camera& camera, const RenderSettings& render,
                          std::size_t recording_bytes, const std::vector<Contestant>& contestants,
                          const ContestSettings& settings, const ContestProgress& progress) {
  return Contest(scene, contestants, settings, progress).run(camera, render, recording_bytes);
}

}  // namespace candil

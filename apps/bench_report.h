/// What `candil bench` found, for people, for machines, and as a drawing.
#pragma once

#include <string>
#include <vector>

#include "apps/chart.h"
#include "apps/command_options.h"
#include "apps/machine.h"
#include "apps/scene_summary.h"
#include "bench/contest.h"

namespace candil {

struct BenchedScene {
  std::filesystem::path file;
  SceneSummary summary;
  ContestResult result;

  /// Triangles and shapes, stored once each.
  std::size_t primitives() const;
};

struct BenchReport {
  BenchOptions options;
  Machine machine;
  std::vector<BenchedScene> scenes;
};

/// Tables of one scene.
std::string bench_tables(const BenchReport& report, const BenchedScene& scene);
/// "Intel Xeon, 2 processors; candil ...": one line.
std::string describe_machine(const BenchReport& report);
std::string bench_json(const BenchReport& report);
/// A bar for each scene, kind of ray and contestant: the rates with the largest number of threads.
Chart bench_chart(const BenchReport& report);
/// One line for each contestant whose answers differ.
std::vector<std::string> describe_mismatches(const BenchedScene& scene);

}  // namespace candil

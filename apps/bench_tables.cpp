#include <fmt/format.h>

#include <algorithm>

#include "apps/bench_numbers.h"
#include "apps/bench_report.h"
#include "apps/messages.h"
#include "apps/versions.h"

namespace candil {
namespace {

std::string threads_text(int threads) { return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s"); }

/// Columns as wide as their widest cell; the first one left-aligned, the others too, so that units stand below units.
class Table {
 public:
  void add_row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  std::string text() const {
    std::vector<std::size_t> widths;
    for (const auto& row : rows_) {
      widths.resize(std::max(widths.size(), row.size()), 0);
      for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string result;
    for (const auto& row : rows_) {
      std::string line = "  ";
      for (std::size_t i = 0; i < row.size(); ++i) line += fmt::format("{:<{}}", row[i], widths[i] + 2);
      line.erase(line.find_last_not_of(' ') + 1);
      result += line + "\n";
    }
    return result;
  }

 private:
  std::vector<std::vector<std::string>> rows_;
};

std::string describe_scene(const BenchReport& report, const BenchedScene& scene) {
  const SceneSummary& s = scene.summary;
  const ContestResult& r = scene.result;
  std::string text = fmt::format("{}: {} triangles", printable(scene.file.string()), with_thousands(s.triangles));
  if (s.instanced_triangles != s.triangles)
    text += fmt::format(", {} with instances ({})", with_thousands(s.instanced_triangles), with_thousands(s.instances));
  const std::size_t shapes = s.spheres + s.discs + s.planes;
  if (shapes > 0) text += fmt::format(", {} shape{}", with_thousands(shapes), shapes == 1 ? "" : "s");
  std::size_t rays = 0;
  for (const RayKind kind : ray_kinds) rays += r.rays[kind];
  text += fmt::format("\n{}x{} at {} spp: {} rays recorded, {}", report.options.size.width, report.options.size.height,
                      report.options.samples_per_pixel, with_thousands(rays),
                      in_bytes(static_cast<double>(r.recorded_bytes)));
  if (r.paths < r.paths_wanted)
    text +=
        fmt::format("; {} of {} paths did not fit into the {} MB of --memory", with_thousands(r.paths_wanted - r.paths),
                    with_thousands(r.paths_wanted), report.options.recording_bytes >> 20);
  return text + "\n";
}

std::string build_table(const BenchReport& report, const BenchedScene& scene) {
  const bool has_instances = scene.result.contestants.front().bytes_per_instance.has_value();
  Table table;
  std::vector<std::string> head = {"Build"};
  for (const int threads : report.options.threads) head.push_back(threads_text(threads));
  head.insert(head.end(), {"memory", "per primitive"});
  if (has_instances) head.emplace_back("per instance");
  table.add_row(head);
  for (const ContestantResult& contestant : scene.result.contestants) {
    std::vector<std::string> row = {contestant.name};
    for (const Spread& seconds : contestant.build_seconds)
      row.push_back(
          fmt::format("{} ({} to {})", in_seconds(seconds.median), in_seconds(seconds.min), in_seconds(seconds.max)));
    const auto bytes = static_cast<double>(contestant.memory_bytes);
    row.push_back(in_bytes(bytes));
    row.push_back(in_bytes(bytes / static_cast<double>(std::max<std::size_t>(1, scene.primitives()))));
    if (has_instances) row.push_back(in_bytes(contestant.bytes_per_instance.value_or(0)));
    table.add_row(row);
  }
  return table.text();
}

bool is_partial(const RayRate& rate, std::size_t rays) { return rate.rays < rays; }

std::vector<std::string> rate_row(const std::string& name, const PerRayKind<RayRate>& rates,
                                  const PerRayKind<std::size_t>& rays) {
  std::vector<std::string> row = {name};
  for (const RayKind kind : ray_kinds) {
    const RayRate& rate = rates[kind];
    row.push_back(rate.rays == 0
                      ? "-"
                      : fmt::format("{}{} ({} to {}) x{:.2f}", in_millions(rate.rays_per_second.median),
                                    is_partial(rate, rays[kind]) ? "*" : "", in_millions(rate.rays_per_second.min),
                                    in_millions(rate.rays_per_second.max), rate.ratio.median));
  }
  return row;
}

std::string rate_table(const BenchReport& report, const BenchedScene& scene, std::size_t t) {
  const ContestResult& result = scene.result;
  Table table;
  std::vector<std::string> head = {"Mrays/s, " + threads_text(report.options.threads[t])};
  for (const RayKind kind : ray_kinds) head.emplace_back(ray_kind_name(kind));
  table.add_row(head);
  for (const ContestantResult& contestant : result.contestants)
    table.add_row(rate_row(contestant.name, contestant.rates[t], result.rays));
  if (!result.bare_embree.empty()) table.add_row(rate_row("bare Embree", result.bare_embree[t], result.rays));
  return table.text();
}

std::string overhead_line(const BenchReport& report, const BenchedScene& scene, std::size_t t) {
  const RenderOverhead& o = scene.result.overhead[t];
  std::string text = fmt::format("  {:.2f} with {}: {} Mrays/s, {} Msamples/s; primary {:.2f}", o.total.median,
                                 threads_text(report.options.threads[t]), in_millions(o.rays_per_second.median),
                                 in_millions(o.samples_per_second.median), o.primary.median);
  if (o.first_bounce != 0) text += fmt::format(", first bounce and its shadow rays {:.2f}", o.first_bounce);
  if (o.deeper != 0) text += fmt::format(", deeper {:.2f}", o.deeper);
  if (o.bare_total.median != 0) text += fmt::format("; {:.2f} of bare Embree", o.bare_total.median);
  return text + "\n";
}

std::string agreement_lines(const BenchedScene& scene) {
  std::string text;
  const std::string& first = scene.result.contestants.front().name;
  for (const ContestantResult& contestant : scene.result.contestants) {
    Agreement sum;
    for (const RayKind kind : ray_kinds) sum += contestant.agreement[kind];
    if (sum.rays == 0) continue;
    text += fmt::format("  {}: {} answers compared with those of {}, {} ties, {} wrong\n", contestant.name,
                        with_thousands(sum.rays), first, with_thousands(sum.ties), with_thousands(sum.mismatches));
  }
  return text;
}

bool has_partial_rates(const ContestResult& result) {
  return std::ranges::any_of(result.contestants, [&](const ContestantResult& contestant) {
    return std::ranges::any_of(
        ray_kinds, [&](RayKind kind) { return is_partial(contestant.rates.front()[kind], result.rays[kind]); });
  });
}

}  // namespace

std::size_t BenchedScene::primitives() const {
  return summary.triangles + summary.spheres + summary.discs + summary.planes;
}

std::string describe_machine(const BenchReport& report) {
  const Machine& m = report.machine;
  return fmt::format("{}, {} processors, load {:.1f}; {}, {}\n", printable(m.processor), m.hardware_threads, m.load,
                     version_line(), m.compiler);
}

std::string bench_tables(const BenchReport& report, const BenchedScene& scene) {
  std::string text = describe_scene(report, scene) + "\n" + build_table(report, scene) + "\n";
  for (std::size_t t = 0; t < report.options.threads.size(); ++t) text += rate_table(report, scene, t) + "\n";
  if (has_partial_rates(scene.result)) text += "  * of a part of the rays, see --limit\n\n";
  text += agreement_lines(scene);
  text += "  Share of a render that its rays need:\n";
  for (std::size_t t = 0; t < report.options.threads.size(); ++t) text += "  " + overhead_line(report, scene, t);
  return text + "\n";
}

std::vector<std::string> describe_mismatches(const BenchedScene& scene) {
  std::vector<std::string> lines;
  const auto describe = [](const Mismatch& mismatch, const Hit& hit) {
    if (mismatch.is_shadow) return std::string(hit.is_miss() ? "nothing" : "something");
    if (hit.is_miss()) return std::string("nothing");
    const std::string part = hit.is_shape() ? "shape" : fmt::format("mesh {} triangle", hit.mesh);
    return fmt::format("{} {} at {:g} m", part, hit.triangle, hit.t);
  };
  for (const ContestantResult& contestant : scene.result.contestants) {
    Agreement sum;
    for (const RayKind kind : ray_kinds) sum += contestant.agreement[kind];
    if (!sum.first_mismatch) continue;
    const Mismatch& m = *sum.first_mismatch;
    lines.push_back(fmt::format(
        "{}: {}: {} of {} answers differ from those of {}; the first: {} ray from {:g},{:g},{:g} along {:g},{:g},{:g} "
        "hits {} instead of {}",
        scene.file.string(), contestant.name, with_thousands(sum.mismatches), with_thousands(sum.rays),
        scene.result.contestants.front().name, m.is_shadow ? "shadow" : "path", m.ray.origin.x, m.ray.origin.y,
        m.ray.origin.z, m.ray.direction.x, m.ray.direction.y, m.ray.direction.z, describe(m, m.found),
        describe(m, m.expected)));
  }
  return lines;
}

}  // namespace candil

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/bench_report.h"
#include "apps/versions.h"
#include "core/accelerator.h"
#include "io/image_file.h"

namespace candil {
namespace {

using Json = nlohmann::ordered_json;

std::string key_of(RayKind kind) {
  std::string name = ray_kind_name(kind);
  std::ranges::replace(name, ' ', '_');
  return name;
}

Json describe(const Spread& spread) { return {{"min", spread.min}, {"median", spread.median}, {"max", spread.max}}; }

Json describe(const PerRayKind<RayRate>& rates) {
  Json json = Json::object();
  for (const RayKind kind : ray_kinds) {
    const RayRate& rate = rates[kind];
    json[key_of(kind)] = {
        {"rays", rate.rays}, {"rays_per_second", describe(rate.rays_per_second)}, {"ratio", describe(rate.ratio)}};
  }
  return json;
}

Json describe(const PerRayKind<Agreement>& agreement) {
  Json json = Json::object();
  for (const RayKind kind : ray_kinds) {
    const Agreement& a = agreement[kind];
    json[key_of(kind)] = {{"rays", a.rays}, {"ties", a.ties}, {"mismatches", a.mismatches}};
  }
  return json;
}

Json describe(const RenderOverhead& overhead) {
  return {{"rays_per_second", describe(overhead.rays_per_second)},
          {"samples_per_second", describe(overhead.samples_per_second)},
          {"share", describe(overhead.total)},
          {"primary_share", describe(overhead.primary)},
          {"first_bounce_share", overhead.first_bounce},
          {"deeper_share", overhead.deeper},
          {"share_of_bare_embree", describe(overhead.bare_total)}};
}

Json describe(const SceneSummary& summary) {
  return {{"triangles", summary.triangles},
          {"instanced_triangles", summary.instanced_triangles},
          {"instances", summary.instances},
          {"objects", summary.objects},
          {"shapes", summary.spheres + summary.discs + summary.planes}};
}

/// One value for each number of threads, which is put beside it.
template <typename Values>
Json for_threads(const std::vector<int>& threads, const Values& values, const char* key = nullptr) {
  Json list = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    Json item = {{"threads", threads[i]}};
    if (key) {
      item[key] = describe(values[i]);
    } else {
      item.update(describe(values[i]));
    }
    list.push_back(std::move(item));
  }
  return list;
}

Json describe(const ContestantResult& contestant, const BenchedScene& scene, const std::vector<int>& threads) {
  const auto bytes = static_cast<double>(contestant.memory_bytes);
  Json json;
  json["name"] = contestant.name;
  json["build"] = for_threads(threads, contestant.build_seconds, "seconds");
  json["memory_bytes"] = contestant.memory_bytes;
  json["bytes_per_primitive"] = bytes / static_cast<double>(std::max<std::size_t>(1, scene.primitives()));
  json["bytes_per_instance"] = nullptr;
  if (contestant.bytes_per_instance) json["bytes_per_instance"] = *contestant.bytes_per_instance;
  json["agreement"] = describe(contestant.agreement);
  json["rates"] = for_threads(threads, contestant.rates);
  return json;
}

Json describe(const BenchedScene& scene, const std::vector<int>& threads) {
  const ContestResult& result = scene.result;
  Json json;
  json["file"] = scene.file.string();
  json["scene"] = describe(scene.summary);
  json["paths"] = result.paths;
  json["paths_left_out"] = result.paths_wanted - result.paths;
  json["recorded_bytes"] = result.recorded_bytes;
  json["rays"] = Json::object();
  for (const RayKind kind : ray_kinds) json["rays"][key_of(kind)] = result.rays[kind];
  json["contestants"] = Json::array();
  for (const ContestantResult& contestant : result.contestants)
    json["contestants"].push_back(describe(contestant, scene, threads));
  json["bare_embree"] = for_threads(threads, result.bare_embree);
  json["renderer"] = for_threads(threads, result.overhead);
  return json;
}

}  // namespace

std::string bench_json(const BenchReport& report) {
  const BenchOptions& options = report.options;
  Json json;
  json["versions"] = {
      {"candil", candil_version()}, {"embree", embree_version()}, {"openimageio", openimageio_version()}};
  json["machine"] = {{"processor", report.machine.processor},
                     {"hardware_threads", report.machine.hardware_threads},
                     {"load", report.machine.load},
                     {"compiler", report.machine.compiler}};
  json["settings"] = {{"width", options.size.width},
                      {"height", options.size.height},
                      {"spp", options.samples_per_pixel},
                      {"repetitions", options.repetitions},
                      {"recording_bytes", options.recording_bytes},
                      {"longest_replay_seconds", options.longest_replay_seconds},
                      {"threads", options.threads},
                      {"tolerance", agreement_tolerance}};
  json["scenes"] = Json::array();
  for (const BenchedScene& scene : report.scenes) json["scenes"].push_back(describe(scene, options.threads));
  // File names need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace candil

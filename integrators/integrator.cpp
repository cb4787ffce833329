#include "integrators/integrator.h"

namespace candil {
namespace {

template <Integrator trace_one>
void trace_each(const RenderContext& context, const RenderSettings& settings, std::span<const CameraSample> samples,
                std::span<PathSample> results, RayCounts& rays) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    results[i] = trace_one(context, settings, samples[i].ray, samples[i].sampler, rays);
  }
}

}  // namespace

std::optional<IntegratorKind> integrator_from_name(std::string_view name) {
  if (name == "path") return IntegratorKind::path;
  if (name == "naive") return IntegratorKind::naive;
  if (name == "classic") return IntegratorKind::classic;
  if (name == "normals") return IntegratorKind::normals;
  if (name == "albedo") return IntegratorKind::albedo;
  return std::nullopt;
}

BatchIntegrator integrator_function(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::path:
      return trace_paths;
    case IntegratorKind::naive:
      return trace_each<trace_naive>;
    case IntegratorKind::classic:
      return trace_each<trace_classic>;
    case IntegratorKind::normals:
      return trace_each<show_normals>;
    case IntegratorKind::albedo:
      return trace_each<show_albedo>;
  }
  return trace_paths;
}

}  // namespace candil

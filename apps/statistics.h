/// What a render took, as JSON for machines.
#pragma once

#include <filesystem>

#include "core/scene.h"
#include "integrators/render.h"

namespace candil {

struct RenderTimes {
  double load = 0;  ///< Seconds for files, textures, environment, and the tables of lights and closures.
  double bvh = 0;   ///< Seconds for the acceleration structure.
};

/// Writes `path` atomically; throws OutputError.
void write_statistics(const std::filesystem::path& path, const Scene& scene, const RenderSettings& settings,
                      const RenderResult& result, const RenderTimes& times, std::size_t bvh_bytes);

}  // namespace candil

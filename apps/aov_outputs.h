/// Which AOVs are wanted, and the files that they go into.
#pragma once

#include "apps/outputs.h"
#include "core/film.h"
#include "core/scene.h"
#include "integrators/aov.h"

namespace candil {

struct AovOptions {
  std::vector<Aov> list;       ///< Each once, in the order of the enumeration.
  bool with_variance = false;  ///< The variance of the picture as one more.
  bool is_separate = false;    ///< Files of their own, also where an output has layers.
};

/// The layer with the variance of the means of the pixels, "variance.R", ".G" and ".B".
ImageLayer variance_layer(const Film& film);

/// A file for each AOV, and for the variance: "picture.depth.exr" beside the first output that is a file, in the
/// current folder and named after the scene if none is. Empty when the AOVs are layers of outputs: without
/// AovOptions::is_separate, every .exr file takes them. Throws UsageError when one of them is an output too,
/// OutputError for what cannot be written.
std::vector<Output> plan_aov_files(const AovOptions& options, std::span<const Output> outputs,
                                   const std::filesystem::path& scene);

/// For the header of files with ids: what they count, {"candil:objects", "[\"Floor\", ...]"}, JSON lists in the order
/// of the ids. Not for lists of more than 10000 names.
ImageMetadata describe_ids(const Scene& scene, std::span<const Aov> aovs);

}  // namespace candil

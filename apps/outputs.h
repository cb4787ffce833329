/// The pictures that a render leaves: which ones, whether they can be written, and writing them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/tonemap.h"
#include "io/image_file.h"

namespace candil {

/// A file, or standard output (a PNG) when `path` is "-".
struct Output {
  std::filesystem::path path;

  bool is_standard_output() const { return path == "-"; }
};

/// How linear values become those of display formats.
struct DisplayOptions {
  float exposure = 0;              ///< Stops.
  std::optional<Tonemap> tonemap;  ///< Absent: neutral for pictures, none for the views of normals and albedo.
  bool is_transparent = false;     ///< Alpha is written where the format has it.
  PpmKind ppm = PpmKind::binary;   ///< What .ppm files hold.
};

/// The files that `names` mean; without names INPUT.png in the current folder. Throws UsageError for unknown formats
/// and for standard output twice, OutputError for what cannot be written.
std::vector<Output> plan_outputs(const std::vector<std::string>& names, const std::filesystem::path& input);

/// Throws UsageError when an output or the statistics (no path: none) would replace one of the files that were read.
void check_inputs_survive(std::span<const Output> outputs, const std::filesystem::path& statistics,
                          std::span<const std::filesystem::path> inputs);

/// Throws UsageError when an output would replace `input`.
void check_input_survives(std::span<const Output> outputs, const std::filesystem::path& input);

/// Further images of a render.
struct LayerOutputs {
  std::span<const ImageLayer> layers;
  std::span<const Output> files;  ///< One for each layer; none: the outputs that can hold layers take them all.
};

/// Writes `linear` (premultiplied) to every output, and the layers, also when one of the files fails; throws the first
/// OutputError at the end.
void write_outputs(std::span<const Output> outputs, const Image& linear, const DisplayOptions& display,
                   const ImageMetadata& metadata, const LayerOutputs& further = {});

}  // namespace candil

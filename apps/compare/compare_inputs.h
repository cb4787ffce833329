/// From two files to pairs of images that can be compared number by number.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/compare/compare_options.h"
#include "core/image.h"

namespace candil {

/// One layer of both files, with the same size, channels and kind of values.
struct LayerPair {
  std::string name;  ///< "picture" for the layer without one.
  std::vector<std::string> channels;
  ValueKind kind = ValueKind::linear;
  bool is_8_bit = false;  ///< Both files.
  Image a, b;

  ImagePair pair() const { return {a, b, kind}; }
};

/// The variance that a file carries.
struct FileVariance {
  Image image;
  std::uint32_t samples = 0;  ///< Per pixel; 0: not known.
};

struct CompareInputs {
  int width = 0, height = 0;  ///< Of A.
  std::vector<LayerPair> layers;
  std::optional<FileVariance> variance_a, variance_b;  ///< Both or none; of the picture.
  float rounding = 0;                                  ///< Of the values, relative: ZTestSettings::rounding.
  std::vector<std::string> notes;                      ///< What has been converted or left out.
};

/// Throws InputError, for different sizes too unless B is to be resized.
CompareInputs read_compare_inputs(const CompareOptions& options);

/// The pixels that regions and mask leave. Throws UsageError for a region outside of the image, InputError for the mask
/// or when nothing is left.
PixelSelection select_pixels(const CompareOptions& options, int width, int height);

}  // namespace candil

/// Golden images: EXR files with the picture, the variance of its pixels, and what made it.
///
/// Values are linear, rounded to 11 significant bits (those of a half float, without its range), variances to 3: files
/// are small, and the rounding is far below any noise. A render is rounded likewise before it is compared.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/image.h"
#include "io/image_file.h"

namespace candil {

/// Largest difference that rounding makes between two values that were equal but for their last bits, as a share of the
/// larger one: one step of 11 bits.
inline constexpr float golden_step = 0x1p-10f;

struct GoldenImage {
  Image mean;                    ///< RGB, or RGBA of transparent pictures (premultiplied).
  Image variance;                ///< RGB: of the mean.
  std::optional<Image> display;  ///< What the operator of the test makes of `mean`: display values, not always there.
  std::uint32_t samples = 0;     ///< Per pixel.
  std::string scene_hash;        ///< Of all files that the scene is made of.
  std::string settings;          ///< The words of the command line that made it.
  std::optional<double> flip_noise;  ///< Mean FLIP between this picture and one of another seed.
  ImageMetadata origin;              ///< For people: version, camera, integrator, seed.
};

/// Rounds as files are; what is not finite stays.
void round_golden(GoldenImage& golden);

/// Throws InputError for a file that is no golden image: no variance, a size beyond 4096, no number of samples.
GoldenImage read_golden(const std::filesystem::path& path);

/// `golden` is rounded. The same golden image gives the same bytes. Atomic; makes the folder; throws OutputError.
void write_golden(const std::filesystem::path& path, const GoldenImage& golden);

/// 16 hexadecimal digits: of the contents of the files, in their order, whatever their names. Throws InputError.
std::string hash_files(const std::vector<std::filesystem::path>& files);
/// Likewise of a text.
std::string hash_text(const std::string& text);

}  // namespace candil

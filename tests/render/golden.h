/// Golden images that hold for any seed and processor: what a right render looks like, and how it spreads.
///
/// A render of few samples is compared with `golden_replicates` renders of as many samples and other seeds, by
/// statistics only. Values are L / (1 + L) for radiance L, cut at a limit of each pixel that lone bright samples
/// exceed: the expected value of such a cut value is as well defined as that of L, and no sample can outweigh the
/// others.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "core/image.h"

namespace candil::test {

inline constexpr int golden_replicates = 16;

/// Three RGB images of one size. In a file they stand one below the other.
struct Golden {
  Image mean;    ///< Of the cut values, over all replicates.
  Image spread;  ///< Standard deviation of the cut values from one replicate to another.
  Image limit;   ///< Where values are cut: six robust standard deviations above the median of the replicates.
};

/// `replicate(seed)` renders one RGB or RGBA image of radiance for each seed from 1 to golden_replicates.
Golden make_golden(const std::function<Image(std::uint64_t seed)>& replicate);

/// As EXR; values are rounded to 11 significant bits (spread and limit: 8) so that files are small.
void write_golden(const std::filesystem::path& path, const Golden& golden);
Golden read_golden(const std::filesystem::path& path);

/// How far a render is from its golden image. Scores are standard normal deviates: what differences of means weigh,
/// given their spread as estimated from a few replicates.
struct Deviation {
  double image = 0;          ///< Largest score of a channel's mean over the whole image.
  double block = 0;          ///< Largest score of a channel's mean over a block of 8 x 8 pixels.
  std::string where;         ///< The block of it.
  double outlier_share = 0;  ///< Of the pixels that are more than five standard deviations off in a channel.
};

/// `render`: radiance, of another seed than the replicates and with as many samples.
Deviation deviation(const Golden& golden, const Image& render);

// What a right render exceeds less than once in a million runs of all golden images together.
/// Some 40 images of 3 channels: 120 scores, each beyond 6 with probability 2.0e-9: 2.4e-7.
inline constexpr double image_limit = 6;
/// 40 images of at most 48 blocks of 3 channels: 5760 scores, each beyond 6.6 with probability 4.1e-11: 2.4e-7.
inline constexpr double block_limit = 6.6;
/// A pixel is an outlier by chance when the render shows what no replicate did: light that falls on it in a share p of
/// all renders. p (1 - p)^16 is at most 0.022. Were every pixel of that kind, the share in 2304 pixels would be 0.022
/// with a standard deviation of 0.0031; 0.04 is 5.8 of them above it: 4e-9 for one image, 1.5e-7 for 40.
inline constexpr double outlier_limit = 0.04;

}  // namespace candil::test

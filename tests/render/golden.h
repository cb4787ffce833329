/// Golden images that hold for any seed and processor: what a right render looks like, and how it spreads.
///
/// A render of few samples is compared with `golden_replicates` renders of as many samples and other seeds, by
/// statistics only. Values are L / (1 + L) for radiance L, cut at a limit of each pixel that lone bright samples
/// exceed: the expected value of such a cut value is as well defined as that of L, and no sample can outweigh the
/// others. The limit is of further renders, since a limit that a value helps to choose cuts it less.
///
/// The render is also compared with one of its own seed, 0, pixel by pixel. Where the same random numbers make the same
/// paths, all that is unchanged cancels, and small faults stand out. Where they do not (another sampler, processor or
/// Embree), the differences are as likely up as down, whatever their sizes, and cancel in the sum.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "core/image.h"

namespace candil::test {

inline constexpr int golden_replicates = 16;

/// Four RGB images of one size. In a file they stand one below the other.
struct Golden {
  Image mean;     ///< Of the cut values, over all replicates.
  Image spread;   ///< Standard deviation of the cut values from one replicate to another.
  Image limit;    ///< Where values are cut: six robust standard deviations above the median of as many other renders.
  Image example;  ///< One render, of seed 0, not cut.
};

/// `replicate(seed)` renders one RGB or RGBA image of radiance: seed 0 is the example, seeds 1 to golden_replicates
/// give mean and spread, the next golden_replicates seeds the limit. Throws std::runtime_error when a value is not
/// finite.
Golden make_golden(const std::function<Image(std::uint64_t seed)>& replicate);

/// As EXR; values are rounded to 11 significant bits (spread and limit: 8) so that files are small. Reading throws
/// std::runtime_error when the image is not of that kind.
void write_golden(const std::filesystem::path& path, const Golden& golden);
Golden read_golden(const std::filesystem::path& path);

/// How far a render is from its golden image. Scores of image and block are standard normal deviates: what differences
/// of means weigh, given their spread as estimated from a few replicates.
struct Deviation {
  double image = 0;          ///< Largest score of a channel's mean over the whole image.
  double block = 0;          ///< Largest score of a channel's mean over a block of 8 x 8 pixels.
  std::string where;         ///< The block of it.
  double outlier_share = 0;  ///< Of the pixels that are more than five standard deviations off in a channel.
  double paired = 0;         ///< Largest |sum| / sqrt(sum of squares) of a channel's differences from the example.
};

/// `render`: radiance, of seed 0 (any but those of the replicates) and with as many samples. Throws std::runtime_error
/// when sizes differ or a value is not finite.
Deviation deviation(const Golden& golden, const Image& render);

// What a right render exceeds, in any of all golden images, for less than one change of code or machine in a million.
// The same code on the same machine has the same deviation every time.
/// 38 images of 3 channels: 114 scores, each beyond 6 with probability 2.0e-9: 2.3e-7.
inline constexpr double image_limit = 6;
/// 38 images of at most 48 blocks of 3 channels: 5472 scores, each beyond 6.6 with probability 4.1e-11: 2.3e-7.
inline constexpr double block_limit = 6.6;
/// A pixel is an outlier by chance when the render shows what no replicate did: light that falls on it in a share p of
/// all renders. p (1 - p)^16 is at most 0.022. Were every pixel of that kind, the share in 2304 pixels would be 0.022
/// with a standard deviation of 0.0031; 0.04 is 5.8 of them above it: 4e-9 for one image, 1.5e-7 for 38.
inline constexpr double outlier_limit = 0.04;
/// Two renders that differ by chance alone may be exchanged in any pixel: given their sizes, the differences have
/// independent signs, and a score beyond x has at most the probability 2 exp(-x^2 / 2) (W. Hoeffding, Probability
/// inequalities for sums of bounded random variables, 1963, theorem 2): 1.3e-9, and 1.5e-7 for 114 scores.
inline constexpr double paired_limit = 6.5;

bool is_within_limits(const Deviation& deviation);

/// For messages of GoogleTest.
void PrintTo(const Deviation& deviation, std::ostream* stream);

}  // namespace candil::test

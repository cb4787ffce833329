/// Numbers that sum up a map of one value per pixel.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "metrics/image_pair.h"

namespace candil {

/// Over the pixels that count; of none: 0. A value that is not a number makes the mean one too.
double map_mean(const Image& map, const PixelSelection& selection);

/// The smallest values that at least these shares of the pixels do not exceed (nearest rank): 0 gives the smallest
/// value of all, 0.5 the (lower) median, 1 the largest. Exact, not binned. NaN ranks above everything; of no pixels: 0.
std::vector<float> map_quantiles(const Image& map, const PixelSelection& selection, std::span<const double> shares);

/// The values at these places of the sorted list of values, counted from 0 and below the number of pixels that count.
std::vector<float> map_order_statistics(const Image& map, const PixelSelection& selection,
                                        std::span<const std::size_t> ranks);

/// How many pixels have a value in each of `bins` equal parts of [low, high]; values beyond count in the outer ones.
std::vector<std::size_t> map_histogram(const Image& map, const PixelSelection& selection, float low, float high,
                                       int bins);

}  // namespace candil

/// The names of the metrics, and what is good.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace candil {

/// Of an image A that is wanted and an image B; d = b - a.
enum class Metric {
  exact,   ///< Pixels with any difference.
  max,     ///< Largest |d|.
  error,   ///< |d|, largest of the channels: a map; its mean.
  mse,     ///< Mean d^2.
  rmse,    ///< Root of it.
  relmse,  ///< Mean d^2 / (a^2 + 0.01).
  psnr,    ///< Decibels.
  bias,    ///< Mean d of the channel where it is farthest from 0; judged without its sign.
  ssim,    ///< A map, 1 where nothing differs; its mean.
  flip,    ///< A map, 0 where no difference is seen; its mean.
  ztest    ///< The chance that it is noise.
};

std::span<const Metric> all_metrics();
std::string metric_name(Metric metric);
/// Nothing for an unknown name.
std::optional<Metric> metric_from_name(std::string_view name);

/// Error, SSIM and FLIP: a value for every pixel, so that there are quantiles.
bool has_map(Metric metric);
/// PSNR, SSIM and the z-test: small values mean a difference.
bool is_better_when_larger(Metric metric);

}  // namespace candil

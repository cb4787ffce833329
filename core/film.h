/// Where samples are summed. One pixel has one writer at a time, so there is no locking.
#pragma once

#include <cstdint>

#include "core/block_sums.h"
#include "core/image.h"

namespace candil {

/// Sums over a set of samples of one pixel; a value type that adds up. PixelSums{} is zero; without the braces it has
/// no value, so that arrays of it cost nothing to make.
struct PixelSums {
  Vec3 radiance;
  float alpha;
  Vec3 radiance_squared;

  PixelSums& operator+=(const PixelSums& other) {
    radiance += other.radiance, alpha += other.alpha, radiance_squared += other.radiance_squared;
    return *this;
  }
};

/// Samples of the next block of a render that has `samples_done` and wants `samples_wanted` (more) samples per pixel: a
/// power of two that divides `samples_done`, 1 at first and 16 at the most. A picture appears at once, and an interrupt
/// is never far.
std::uint32_t next_block_size(std::uint32_t samples_done, std::uint32_t samples_wanted);

/// Float film of width x height pixels. Blocks of samples are given to it in the order of their sample index.
class Film {
 public:
  Film(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Samples per pixel summed so far.
  std::uint32_t sample_count() const { return sums_.sample_count(); }

  /// Room for the sums of the next block; threads fill disjoint pixels through block_pixel().
  void begin_block() { sums_.begin_block(); }
  PixelSums& block_pixel(int x, int y) { return sums_.block_pixel(static_cast<std::size_t>(y) * width_ + x); }
  /// Adds the block, every pixel of which holds the sum of `samples` samples: a power of two that divides
  /// sample_count(), as next_block_size() gives it.
  void end_block(std::uint32_t samples) { sums_.end_block(samples); }
  /// Forgets a block that was not finished (interrupted render).
  void drop_block() { sums_.drop_block(); }

  /// RGBA, linear: mean radiance and mean alpha. Radiance is premultiplied. Zero when there are no samples.
  Image mean() const;
  /// RGB: variance of the mean, estimated from the spread of single samples. Zero below two samples.
  Image variance() const;
  /// Root of the mean over pixels of the luminance's variance, divided by the mean luminance: the noise that is shown
  /// to the user. Zero below two samples.
  float relative_noise() const;

 private:
  int width_, height_;
  BlockSums<PixelSums> sums_;
};

}  // namespace candil

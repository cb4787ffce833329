/// Sums over the samples of pixels whose bits do not depend on how the samples are cut into blocks.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace candil {

/// Adds samples pairwise like the carries of a binary counter: the order of additions is one fixed binary tree over the
/// sample index, whatever blocks the samples arrive in. Hence a render that is cut into blocks of a power of two
/// samples (aligned to their size) gives the same bits as one that is not. Sums{} is zero; Sums without the braces may
/// have no value.
template <typename Sums>
class PairwiseSum {
 public:
  void add(const Sums& sample) {
    Sums carry = sample;
    int level = 0;
    for (; (count_ >> level) & 1; ++level) {
      Sums sum = levels_[level];
      sum += carry;
      carry = sum;
    }
    levels_[level] = carry;
    ++count_;
  }

  /// Remaining partial sums, smallest first.
  Sums total() const {
    Sums sum{};
    for (std::uint32_t levels = count_; levels != 0; levels &= levels - 1) sum += levels_[std::countr_zero(levels)];
    return sum;
  }

 private:
  static constexpr int max_levels = 32;
  Sums levels_[max_levels];  // those of the set bits of count_ have a value
  std::uint32_t count_ = 0;
};

/// The same tree over blocks, for many pixels at once: blocks come in the order of their sample index, each with the
/// PairwiseSum of its samples.
template <typename Sums>
class BlockSums {
 public:
  explicit BlockSums(std::size_t pixels) : pixels_(pixels) {}

  /// Samples per pixel summed so far.
  std::uint32_t sample_count() const { return sample_count_; }

  /// Room for the sums of the next block; threads fill disjoint pixels through block_pixel().
  void begin_block() { block_.assign(pixels_, Sums{}); }
  Sums& block_pixel(std::size_t pixel) { return block_[pixel]; }
  /// Adds the block, every pixel of which holds the sum of `samples` samples: a power of two that divides
  /// sample_count().
  void end_block(std::uint32_t samples) {
    assert(samples > 0 && (samples & (samples - 1)) == 0 && sample_count_ % samples == 0);
    sample_count_ += samples;
    levels_.push_back({samples, std::move(block_)});
    while (levels_.size() >= 2 && levels_[levels_.size() - 2].samples == levels_.back().samples) {
      Level& left = levels_[levels_.size() - 2];
      const Level& right = levels_.back();
      for (std::size_t i = 0; i < left.sums.size(); ++i) left.sums[i] += right.sums[i];
      left.samples *= 2;
      block_ = std::move(levels_.back().sums);  // its memory serves the next block
      levels_.pop_back();
    }
  }
  /// Forgets a block that was not finished (interrupted render).
  void drop_block() { block_.clear(); }

  Sums total(std::size_t pixel) const {
    Sums sum{};
    for (auto level = levels_.rbegin(); level != levels_.rend(); ++level) sum += level->sums[pixel];
    return sum;
  }

 private:
  struct Level {
    std::uint32_t samples = 0;
    std::vector<Sums> sums;
  };

  std::size_t pixels_;
  std::uint32_t sample_count_ = 0;
  std::vector<Level> levels_;  // binary counter of blocks, largest first
  std::vector<Sums> block_;
};

}  // namespace candil

/// Random numbers as a pure function of (seed, pixel, sample index, dimension): Owen-scrambled Sobol points.
///
/// Every dimension (a pair of numbers) is the two-dimensional Sobol sequence, with its own scrambling and its own
/// shuffled order of the samples, so that the pairs are stratified each by itself and independent of each other (Burley
/// 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)). Since there is no state, nothing depends on who asks when.
#pragma once

#include <array>
#include <cstring>

#include "core/hash.h"
#include "core/simd.h"

namespace candil {

/// Bits in reverse order. All functions below take an integer or eight.
template <typename Integer>
Integer reverse_bits(Integer x) {
  x = ((x & 0x0000ffffU) << 16) | (x >> 16);
  x = ((x & 0x00ff00ffU) << 8) | ((x >> 8) & 0x00ff00ffU);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

/// Permutes integers such that each bit depends on the bits below it only: an Owen scrambling of the bit-reversed value
/// (Laine and Karras 2011, with the constants of Nathan Vegdahl 2021).
template <typename Integer>
Integer laine_karras_permutation(Integer x, Integer seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

/// The second Sobol dimension of an index, bits reversed. Its generator is Pascal's triangle modulo 2: bit j is
/// the exclusive or of all index bits whose position contains j as a set of binary digits, done here a digit at a time.
template <typename Integer>
Integer sobol_second_dimension_reversed(Integer index) {
  index ^= (index >> 1) & 0x55555555U;
  index ^= (index >> 2) & 0x33333333U;
  index ^= (index >> 4) & 0x0f0f0f0fU;
  index ^= (index >> 8) & 0x00ff00ffU;
  return index ^ (index >> 16);
}

/// Four points in [0, 1)^2.
struct FourPoints {
  FloatLanes coordinates;  ///< The x of all, then the y.

  Vec2 operator[](int i) const { return {coordinates[i], coordinates[i + 4]}; }
};

class Sampler {
 public:
  Sampler(glm::uvec2 pixel, std::uint32_t sample_index, std::uint64_t seed)
      : pixel_seed_(pixel_seed(pixel, seed)), reversed_index_(reverse_bits(sample_index)) {}

  /// The sampler of another sample of the same pixel.
  Sampler at_sample(std::uint32_t sample_index) const {
    Sampler other = *this;
    other.reversed_index_ = reverse_bits(sample_index);
    return other;
  }

  /// A point in [0, 1)^2. The points of the first 2^k samples form a (0, k, 2)-net.
  Vec2 sample_2d(std::uint32_t dimension) const {
    const std::uint32_t dimension_seed = hash_combine(pixel_seed_, dimension);
    const std::uint32_t index = shuffled_index(dimension_seed);
    const std::uint32_t x = laine_karras_permutation(index, dimension_seed * x_scramble);
    const std::uint32_t y =
        laine_karras_permutation(sobol_second_dimension_reversed(index), dimension_seed * y_scramble);
    return {to_unit_float(reverse_bits(x)), to_unit_float(reverse_bits(y))};
  }

  /// sample_2d() of eight samplers at once, to the bit: the x of all, then the y.
  static std::array<FloatLanes, 2> sample_2d(const std::array<Sampler, 8>& samplers, std::uint32_t dimension) {
    static_assert(sizeof samplers == 2 * sizeof(Lanes));
    Lanes a, b;
    std::memcpy(&a, &samplers[0], sizeof a);
    std::memcpy(&b, &samplers[4], sizeof b);
    const Lanes seed = hash_combine(__builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14), Lanes{} + dimension);
    return scrambled(__builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15), seed);
  }

  /// sample_2d() of four dimensions in a row, to the bit, for little more than the price of one.
  FourPoints sample_four_2d(std::uint32_t first_dimension) const {
    return sample_four_2d({*this, *this}, {first_dimension, first_dimension})[0];
  }

  /// The same for two samplers, for little more than the price of one.
  static std::array<FourPoints, 2> sample_four_2d(const std::array<Sampler, 2>& samplers,
                                                  const std::array<std::uint32_t, 2>& first_dimensions) {
    const auto& [a, b] = samplers;
    const auto both = [](std::uint32_t first, std::uint32_t second) {
      return Lanes{first, first, first, first, second, second, second, second};
    };
    const Lanes dimension = both(first_dimensions[0], first_dimensions[1]) + Lanes{0, 1, 2, 3, 0, 1, 2, 3};
    const Lanes seed = hash_combine(both(a.pixel_seed_, b.pixel_seed_), dimension);
    const auto [x, y] = scrambled(both(a.reversed_index_, b.reversed_index_), seed);
    return {FourPoints{__builtin_shufflevector(x, y, 0, 1, 2, 3, 8, 9, 10, 11)},
            FourPoints{__builtin_shufflevector(x, y, 4, 5, 6, 7, 12, 13, 14, 15)}};
  }

 private:
  // Odd factors that turn the seed of a dimension into those of its two scramblings.
  static constexpr std::uint32_t x_scramble = 0x9e3779b9U, y_scramble = 0xc2b2ae35U;

  static std::uint32_t pixel_seed(glm::uvec2 pixel, std::uint64_t seed) {
    const auto low = static_cast<std::uint32_t>(seed), high = static_cast<std::uint32_t>(seed >> 32);
    return hash_combine(hash_combine(hash_combine(hash(low), high), pixel.x), pixel.y);
  }
  /// to_unit_float() of eight. Conversion from signed integers is one instruction; 24 bits have no sign.
  static FloatLanes to_unit_floats(Lanes bits) {
    using SignedLanes = std::int32_t __attribute__((vector_size(32)));
    return __builtin_convertvector(reinterpret_cast<SignedLanes>(bits >> 8), FloatLanes) * 0x1p-24f;
  }
  /// Eight points of the sequences of `seed`.
  static std::array<FloatLanes, 2> scrambled(Lanes reversed_index, Lanes seed) {
    const Lanes index = reverse_bits(laine_karras_permutation(reversed_index, seed));
    return {to_unit_floats(reverse_bits(laine_karras_permutation(index, seed * x_scramble))),
            to_unit_floats(
                reverse_bits(laine_karras_permutation(sobol_second_dimension_reversed(index), seed * y_scramble)))};
  }
  std::uint32_t shuffled_index(std::uint32_t dimension_seed) const {
    return reverse_bits(laine_karras_permutation(reversed_index_, dimension_seed));
  }

  std::uint32_t pixel_seed_, reversed_index_;
};

}  // namespace candil

/// One-dimensional filters over rows of floats, the parts that separable filters of images are made of.
#pragma once

#include <span>
#include <vector>

namespace candil {

/// Half of a symmetric or antisymmetric kernel: the weight in the middle, then those outwards.
/// Symmetric:     out(x) = w(0) in(x) + sum over k > 0 of w(k) (in(x + k) + in(x - k)).
/// Antisymmetric: out(x) = sum over k > 0 of w(k) (in(x + k) - in(x - k)).
struct HalfKernel {
  std::vector<float> weights;
  bool is_symmetric = true;

  int radius() const { return static_cast<int>(weights.size()) - 1; }
};

/// The weights of all places from one end to the other: 2 radius + 1.
std::vector<float> whole_kernel(const HalfKernel& kernel);

/// exp(-k^2 / (2 sigma^2)) for |k| <= radius, summing up to 1.
HalfKernel gaussian_kernel(double sigma, int radius);

/// Filters along a row: outputs have `count` values, `in` has radius more on either side and points at the one that
/// belongs to the first. Input and output do not overlap.
void filter_along_row(const HalfKernel& kernel, const float* in, float* out, int count);

/// Filters across rows: `rows` are those around the one to make, from top to bottom, at least 2 radius + 1 of them.
void filter_across_rows(const HalfKernel& kernel, std::span<const float* const> rows, float* out, int count);

}  // namespace candil

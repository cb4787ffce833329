/// Roots and powers of positive floats that the compiler turns into vector code, unlike those of the C library, and
/// without divisions, which take longer than all the rest. Plain arithmetic: the same bits in a vector and alone, on
/// every processor that the program is built for. Always inline: files for newer processors use them too
/// (core/bvh/target.h).
///
/// Roots start from the bits of x, a share of which is that share of its logarithm, roughly: y is 1 / root(x) to 3.5 %.
/// With h = 1 - x y^n the answer is a power of 1 - h times what y gives, and a short polynomial. Coefficients: least
/// largest error (Remez) over the range of h, or of the argument.
#pragma once

#include <bit>
#include <cstdint>

namespace candil {

/// a b + c, rounded once where the processor has an instruction for it.
[[gnu::always_inline]] inline float multiply_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// Of floats that are not negative, by their bits: one instruction, where compilers compare and choose floats in two.
[[gnu::always_inline]] inline float smaller(float a, float b) {
  const auto p = std::bit_cast<std::int32_t>(a), q = std::bit_cast<std::int32_t>(b);
  return std::bit_cast<float>(p < q ? p : q);
}
[[gnu::always_inline]] inline float larger(float a, float b) {
  const auto p = std::bit_cast<std::int32_t>(a), q = std::bit_cast<std::int32_t>(b);
  return std::bit_cast<float>(p > q ? p : q);
}

/// Cube root of x >= 0, relative error below 5e-7 from 1e-30 on; below, at most 2e-10.
[[gnu::always_inline]] inline float fast_cbrt(float x) {
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
  const float y = std::bit_cast<float>(0x54a1f5bd - static_cast<std::int32_t>(bits * (1 / 3.0f)));
  // x y^2 (1 - h)^(-2/3), |h| <= 0.1021
  const float xyy = x * y * y, h = multiply_add(-xyy, y, 1);
  float series = multiply_add(h, 0.45842135f, 0.49937543f);
  series = multiply_add(h, series, 0.55553746f);
  series = multiply_add(h, series, 0.66665226f);
  return multiply_add(xyy * h, series, xyy);
}

/// Square root of x >= 0, relative error below 3e-7 from 1e-37 on; below, at most 1e-18.
[[gnu::always_inline]] inline float fast_sqrt(float x) {
  const float y = std::bit_cast<float>(0x5f374756 - (std::bit_cast<std::int32_t>(x) >> 1));
  // x y (1 - h)^(-1/2), |h| <= 0.0682
  const float xy = x * y, h = multiply_add(-xy, y, 1);
  float series = multiply_add(h, 0.27494654f, 0.31393290f);
  series = multiply_add(h, series, 0.37499771f);
  series = multiply_add(h, series, 0.49999833f);
  return multiply_add(xy * h, series, xy);
}

/// Base 2 logarithm of a normal x > 0, absolute error below 2e-7 for x in [1/4, 4].
[[gnu::always_inline]] inline float fast_log2(float x) {
  // x = 2^exponent m with m in [1/sqrt 2, sqrt 2).
  const std::int32_t bits = std::bit_cast<std::int32_t>(x), offset = bits - 0x3f3504f3;
  const auto exponent = static_cast<float>(offset >> 23);
  const float t = std::bit_cast<float>((offset & 0x007fffff) + 0x3f3504f3) - 1;
  float series = multiply_add(t, -0.14574444f, 0.23689036f);
  series = multiply_add(t, series, -0.25006905f);
  series = multiply_add(t, series, 0.28670746f);
  series = multiply_add(t, series, -0.36008722f);
  series = multiply_add(t, series, 0.48093945f);
  series = multiply_add(t, series, -0.72135717f);
  series = multiply_add(t, series, 1.44269478f);
  return multiply_add(t, series, exponent);
}

/// 2^x for x in [-125, 127], relative error below 3e-7; below: 2^-125.
[[gnu::always_inline]] inline float fast_exp2(float x) {
  const float bounded = x < -125 ? -125.0f : x;
  // Round to nearest by adding 1.5 * 2^23, which leaves no room for a fraction: the whole number is in the lower bits.
  const float shifted = bounded + 12582912.0f;
  const float t = bounded - (shifted - 12582912.0f);
  float series = multiply_add(t, 0.0013264727f, 0.0096715130f);
  series = multiply_add(t, series, 0.055507336f);
  series = multiply_add(t, series, 0.24022242f);
  series = multiply_add(t, series, 0.69314700f);
  series = multiply_add(t, series, 1);
  const std::uint32_t exponent = std::bit_cast<std::uint32_t>(shifted) << 23;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(series) + exponent);
}

/// x^p for 0 <= x <= 2^30 and p > 0 of a few units, relative error below 3e-6 for x in [1e-6, 1e3]; 0 or something
/// below 1e-20 for x = 0.
[[gnu::always_inline]] inline float fast_pow(float x, float p) {
  constexpr float least = 1e-37f;
  const float power = fast_exp2(p * fast_log2(x < least ? least : x));
  return x < least ? 0.0f : power;
}

}  // namespace candil

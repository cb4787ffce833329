/// Roots and powers of positive floats that the compiler turns into vector code, unlike those of the C library. Plain
/// arithmetic: the same bits in a vector and alone, on every processor that the program is built for.
#pragma once

#include <bit>
#include <cstdint>

namespace candil {

/// a b + c, rounded once where the processor has an instruction for it.
inline float multiply_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__aarch64__)
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// Cube root of x >= 0, relative error below 5e-7 from 1e-30 on; below, that of 1e-30.
inline float fast_cbrt(float x) {
  constexpr float least = 1e-30f;
  x = x < least ? least : x;
  // 1 / cbrt(x) first, which takes no division. A third of the bits is a third of the exponent, and of its logarithm
  // roughly: 4 % off at the worst.
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
  float y = std::bit_cast<float>(0x54a21d2a - static_cast<std::int32_t>(bits * (1 / 3.0f)));
  // With h = 1 - x y^3 the answer is y (1 - h)^(-1/3): the first terms of its series leave 2e-5, then 1e-9.
  float h = multiply_add(-x * y, y * y, 1);
  y = multiply_add(y * h, multiply_add(h, multiply_add(h, 14 / 81.0f, 2 / 9.0f), 1 / 3.0f), y);
  h = multiply_add(-x * y, y * y, 1);
  y = multiply_add(y * h, 1 / 3.0f, y);
  return x * (y * y);
}

/// Base 2 logarithm of a normal x > 0, absolute error below 2e-7 for x in [1/4, 4].
inline float fast_log2(float x) {
  // x = 2^exponent m with m in [1/sqrt 2, sqrt 2), ln m = 2 atanh((m - 1) / (m + 1)).
  const std::int32_t offset = std::bit_cast<std::int32_t>(x) - 0x3f3504f3;
  const auto exponent = static_cast<float>(offset >> 23);
  const float m = std::bit_cast<float>((offset & 0x007fffff) + 0x3f3504f3);
  const float s = (m - 1) / (m + 1), s2 = s * s;
  float series = multiply_add(s2, 1 / 9.0f, 1 / 7.0f);
  series = multiply_add(s2, series, 1 / 5.0f);
  series = multiply_add(s2, series, 1 / 3.0f);
  series = multiply_add(s2, series, 1);
  return multiply_add(2.885390082f * s, series, exponent);  // 2 / ln 2
}

/// 2^x for x in [-126, 127], relative error below 3e-7; below: 2^-126.
inline float fast_exp2(float x) {
  const float bounded = x < -126 ? -126.0f : x;
  // Round to nearest by adding 1.5 * 2^23, which leaves no room for a fraction.
  const float shifted = bounded + 12582912.0f;
  const float whole = shifted - 12582912.0f;
  const float t = (bounded - whole) * 0.6931471806f;  // ln 2; |t| <= 0.3466
  float series = multiply_add(t, 1 / 720.0f, 1 / 120.0f);
  series = multiply_add(t, series, 1 / 24.0f);
  series = multiply_add(t, series, 1 / 6.0f);
  series = multiply_add(t, series, 1 / 2.0f);
  series = multiply_add(t, series, 1);
  series = multiply_add(t, series, 1);
  return series * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

/// x^p for 0 <= x <= 2^30 and p > 0 of a few units, relative error below 3e-6 for x in [1e-6, 1e3]; 0 or something
/// below 1e-20 for x = 0.
inline float fast_pow(float x, float p) {
  constexpr float least = 1e-37f;
  const float power = fast_exp2(p * fast_log2(x < least ? least : x));
  return x < least ? 0.0f : power;
}

}  // namespace candil

/// Roots and powers of positive floats that the compiler turns into vector code, unlike those of the C library. Plain
/// arithmetic: the same bits in a vector and alone, and on every processor.
#pragma once

#include <bit>
#include <cstdint>

namespace candil {

/// Cube root of x >= 0, relative error below 3e-7 from 1e-30 on; below, that of 1e-30.
inline float fast_cbrt(float x) {
  constexpr float least = 1e-30f;
  x = x < least ? least : x;
  // A third of the bits is a third of the exponent, and of its logarithm roughly: 4 % off at the worst.
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
  float y = std::bit_cast<float>(static_cast<std::int32_t>(bits * (1 / 3.0f)) + 0x2a514067);
  // Halley's method triples the digits each time.
  for (int i = 0; i < 2; ++i) {
    const float cube = y * y * y;
    y = y * (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

/// Base 2 logarithm of a normal x > 0, absolute error below 2e-7 for x in [1/4, 4].
inline float fast_log2(float x) {
  // x = 2^exponent m with m in [1/sqrt 2, sqrt 2), ln m = 2 atanh((m - 1) / (m + 1)).
  const std::int32_t offset = std::bit_cast<std::int32_t>(x) - 0x3f3504f3;
  const auto exponent = static_cast<float>(offset >> 23);
  const float m = std::bit_cast<float>((offset & 0x007fffff) + 0x3f3504f3);
  const float s = (m - 1) / (m + 1), s2 = s * s;
  const float series = 1 + s2 * (1 / 3.0f + s2 * (1 / 5.0f + s2 * (1 / 7.0f + s2 * (1 / 9.0f))));
  return exponent + 2.885390082f * s * series;  // 2 / ln 2
}

/// 2^x for x in [-126, 127], relative error below 3e-7; below: 2^-126.
inline float fast_exp2(float x) {
  const float bounded = x < -126 ? -126.0f : x;
  // Round to nearest by adding 1.5 * 2^23, which leaves no room for a fraction.
  const float shifted = bounded + 12582912.0f;
  const float whole = shifted - 12582912.0f;
  const float t = (bounded - whole) * 0.6931471806f;  // ln 2; |t| <= 0.3466
  const float series =
      1 + t * (1 + t * (1 / 2.0f + t * (1 / 6.0f + t * (1 / 24.0f + t * (1 / 120.0f + t * (1 / 720.0f))))));
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

/// Eight floats or integers at once, for hierarchies with eight children: AVX2 where the compiler may use it, else the
/// same in plain loops, so that every processor gets the same tree and (rounding of a fused multiply apart) the same
/// hits.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/bvh/target.h"

#if defined(__AVX2__) && defined(__FMA__)
#define CANDIL_AVX2 1
#include <immintrin.h>
#else
#define CANDIL_AVX2 0
#pragma GCC diagnostic ignored "-Wpsabi"  // everything here is inlined: no vector crosses a call
#endif

namespace candil {

inline constexpr int lane_count = 8;
using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));

inline namespace CANDIL_TARGET {

inline Float8 load8(const void* aligned) {
  Float8 v;
  std::memcpy(&v, __builtin_assume_aligned(aligned, 32), sizeof v);
  return v;
}
inline Float8 splat8(float x) { return Float8{x, x, x, x, x, x, x, x}; }
inline Int8 splat8(std::int32_t x) { return Int8{x, x, x, x, x, x, x, x}; }
inline Int8 bits8(Float8 v) { return std::bit_cast<Int8>(v); }
inline Float8 floats8(Int8 v) { return std::bit_cast<Float8>(v); }

#if CANDIL_AVX2

/// Eight bytes as floats.
inline Float8 load_bytes8(const void* bytes) {
  return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64(static_cast<const __m128i*>(bytes))));
}
/// a * b + c, rounded once.
inline Float8 multiply_add(Float8 a, Float8 b, Float8 c) { return _mm256_fmadd_ps(a, b, c); }
inline Float8 minimum(Float8 a, Float8 b) { return _mm256_min_ps(a, b); }
inline Float8 maximum(Float8 a, Float8 b) { return _mm256_max_ps(a, b); }
inline Int8 minimum(Int8 a, Int8 b) {
  return std::bit_cast<Int8>(_mm256_min_epi32(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b)));
}
inline Int8 maximum(Int8 a, Int8 b) {
  return std::bit_cast<Int8>(_mm256_max_epi32(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b)));
}
/// Bit i is the sign of lane i.
inline unsigned sign_bits(Int8 v) { return static_cast<unsigned>(_mm256_movemask_ps(std::bit_cast<__m256>(v))); }

/// The upper halves of eight non-negative floats, as integers: they order like the floats, to 1 part in 128.
struct Keys8 {
  __m128i v;
};
struct NearestKey {
  unsigned key, lane;
};
/// All bits of a lane set: the key 0xffff, beyond that of any float.
inline Keys8 make_keys(Int8 v) {
  const __m256i upper = _mm256_srli_epi32(std::bit_cast<__m256i>(v), 16);
  return {_mm_packus_epi32(_mm256_castsi256_si128(upper), _mm256_extracti128_si256(upper, 1))};
}
/// The smallest key; of equal ones that of the lowest lane.
inline NearestKey nearest_key(Keys8 keys) {
  const auto found = static_cast<unsigned>(_mm_cvtsi128_si32(_mm_minpos_epu16(keys.v)));
  return {found & 0xffff, found >> 16};
}
/// With the key of that lane set to 0xffff.
inline Keys8 without_lane(Keys8 keys, unsigned lane) {
  // Ones in the middle of zeros: a load from `lane` places before them has them at that lane.
  alignas(32) static constexpr std::uint16_t window[16] = {0, 0, 0, 0, 0, 0, 0, 0xffff, 0, 0, 0, 0, 0, 0, 0, 0};
  return {_mm_or_si128(keys.v, _mm_loadu_si128(reinterpret_cast<const __m128i*>(window + 7 - lane)))};
}

#else

inline Float8 load_bytes8(const void* bytes) {
  std::uint8_t v[lane_count];
  std::memcpy(v, bytes, sizeof v);
  Float8 result{};
  for (int i = 0; i < lane_count; ++i) result[i] = v[i];
  return result;
}
inline Float8 multiply_add(Float8 a, Float8 b, Float8 c) { return a * b + c; }
inline Float8 minimum(Float8 a, Float8 b) { return a < b ? a : b; }
inline Float8 maximum(Float8 a, Float8 b) { return a > b ? a : b; }
inline Int8 minimum(Int8 a, Int8 b) { return a < b ? a : b; }
inline Int8 maximum(Int8 a, Int8 b) { return a > b ? a : b; }
inline unsigned sign_bits(Int8 v) {
  unsigned bits = 0;
  for (int i = 0; i < lane_count; ++i) bits |= (v[i] < 0 ? 1U : 0U) << i;
  return bits;
}
struct Keys8 {
  std::uint16_t v[lane_count];
};
struct NearestKey {
  unsigned key, lane;
};
inline Keys8 make_keys(Int8 v) {
  Keys8 keys;
  for (int i = 0; i < lane_count; ++i) keys.v[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(v[i]) >> 16);
  return keys;
}
inline NearestKey nearest_key(Keys8 keys) {
  const std::uint16_t* found = std::min_element(keys.v, keys.v + lane_count);
  return {*found, static_cast<unsigned>(found - keys.v)};
}
inline Keys8 without_lane(Keys8 keys, unsigned lane) {
  keys.v[lane] = 0xffff;
  return keys;
}

#endif

}  // namespace CANDIL_TARGET
}  // namespace candil

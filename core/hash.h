/// Integer hashes: the source of everything that looks random but is a pure function.
#pragma once

#include <bit>
#include <cstdint>

#include "core/math.h"

namespace candil {

/// A bijection of 32-bit integers (or vectors of them, lane by lane) that mixes well (constants: Chris Wellons, "hash
/// prospector", lowbias32).
template <typename Integer>
Integer hash(Integer x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

template <typename Integer>
Integer hash_combine(Integer seed, Integer value) {
  return hash(seed ^ (value * 0x9e3779b9U + 0x7f4a7c15U));
}

inline std::uint32_t hash_combine(std::uint32_t seed, Vec3 v) {
  seed = hash_combine(seed, std::bit_cast<std::uint32_t>(v.x));
  seed = hash_combine(seed, std::bit_cast<std::uint32_t>(v.y));
  return hash_combine(seed, std::bit_cast<std::uint32_t>(v.z));
}

/// The upper 24 bits as a float in [0, 1).
inline float to_unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

}  // namespace candil

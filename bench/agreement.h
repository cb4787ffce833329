/// Whether two accelerators answer alike. Times are only worth something then.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/replay.h"
#include "core/accelerator.h"

namespace candil {

/// How far an answer in float arithmetic may be off, as a part of the largest coordinate that is involved: of the ray's
/// origin, the hit, and the primitive, carried through its instance's transform. Vertices and origins are rounded once
/// (2^-24 each) when they are carried into the space of the test, once more when one is subtracted from the other, and
/// the edge functions add some four roundings of products as large: about 8 * 2^-24 for each of the two that are
/// compared. Four times that for instances, into whose space the ray is carried.
inline constexpr float agreement_tolerance = 0x1p-20f;

/// A ray that two accelerators do not agree on.
struct Mismatch {
  Ray ray;
  bool is_shadow = false;
  Hit expected, found;  ///< Of a shadow ray, is_miss() alone tells: false if something is in its way.
};

struct Agreement {
  std::uint64_t rays = 0;
  std::uint64_t ties = 0;        ///< Another primitive, or hit against miss, but right up to the tolerance.
  std::uint64_t mismatches = 0;  ///< Answered wrongly by one of the two.
  std::optional<Mismatch> first_mismatch;

  Agreement& operator+=(const Agreement& other);
};

/// Shoots the rays through both and compares what they hit. Two answers are the same when primitive, place and distance
/// are, up to the tolerance. Another answer is right too when the place on the primitive is on the ray, and the
/// reference gives that answer for a ray that is moved by the tolerance, sideways or along itself: at edges, on
/// surfaces that coincide, where a ray grazes one, and where it begins or ends on one. What is sought is the backward
/// error (Wilkinson 1963): a right answer to nearly the same question. That needs no knowledge of the primitive, and a
/// leak through a closed surface is not right.
Agreement compare(const Scene& scene, const Accelerator& reference, const Accelerator& other, const RayChoice& choice,
                  RayKind kind, int threads);

}  // namespace candil

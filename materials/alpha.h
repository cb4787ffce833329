/// Alpha coverage and culled back faces: decided inside the traversal, alike for every kind of ray.
#pragma once

#include "core/accelerator.h"

namespace candil {

/// Accepts a hit unless it is on an invisible side or not covered:
/// - the back of a single-sided material is invisible to every ray, unless the material transmits;
/// - MASK: alpha below the cutoff is a hole;
/// - BLEND: alpha is a probability; the random number is a hash of the ray and the triangle, so that the answer
///   is the same whoever asks.
HitFilter alpha_filter();

}  // namespace candil

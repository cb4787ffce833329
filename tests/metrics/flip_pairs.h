/// The pairs of images of flip_pairs.py, by the same formulas.
#pragma once

#include <string>

#include "core/image.h"

namespace candil::test {

struct FlipPair {
  Image a, b;
};

/// By the name in flip_references.
FlipPair make_flip_pair(const std::string& name);

}  // namespace candil::test

/// Finding the layers of a render.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "integrators/render.h"
#include "tests/support/scene_builder.h"

namespace candil::test {

inline const Image& layer(const RenderResult& result, Aov aov) {
  const auto found = std::ranges::find(result.aovs, aov_name(aov), &ImageLayer::name);
  if (found == result.aovs.end()) throw std::runtime_error("no layer " + aov_name(aov));
  return found->image;
}

}  // namespace candil::test

/// Lights of every kind, for tests of sampling them.
#pragma once

#include <iosfwd>
#include <span>

#include "core/surface.h"
#include "tests/support/scene_builder.h"

namespace candil::test {

/// An environment of 8 x 4 texels from black to 300, the bright ones alone.
Image uneven_image();

SurfacePoint point_at(Vec3 position, Vec3 normal = Vec3(0, 1, 0));

/// Single-sided; what it reflects is glTF's default.
Material emitter(Vec3 radiance);

struct LightScene {
  const char* name;
  void (*build)(SceneBuilder&);
};

void PrintTo(const LightScene& scene, std::ostream* stream);

/// Seen from near the origin: area lights of one and two sides, textured, blended and instanced, environments, and all
/// kinds together. "facing_away" alone gives the origin no light.
std::span<const LightScene> light_scenes();

}  // namespace candil::test

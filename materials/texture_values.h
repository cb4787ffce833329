/// What materials look up in their textures.
#pragma once

#include "core/surface.h"
#include "core/texture.h"

namespace candil {

/// One channel of a linear texture; 1 without a texture.
inline float channel(const Scene& scene, const TextureSlot& slot, const SurfacePoint& point, int index) {
  return slot.is_used() ? sample_texture(scene, slot, point.uv, ColorSpace::linear)[index] : 1.0f;
}

/// The factor times an sRGB texture.
inline Vec3 textured_color(const Scene& scene, Vec3 factor, const TextureSlot& slot, const SurfacePoint& point) {
  return slot.is_used() ? factor * Vec3(sample_texture(scene, slot, point.uv, ColorSpace::srgb)) : factor;
}

}  // namespace candil

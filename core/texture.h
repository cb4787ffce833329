/// Texture lookups.
#pragma once

#include "core/scene.h"

namespace candil {

/// How the stored colour of a slot is meant; alpha is always linear.
enum class ColorSpace : std::uint8_t { linear, srgb };

/// Linear RGBA of a slot that is_used() at the point's coordinates `uv` (one per set). Honours wrap modes
/// and the magnification filter; minification needs no mip levels, since the samples of a pixel average the texture.
Vec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Vec2 (&uv)[2], ColorSpace space);

}  // namespace candil

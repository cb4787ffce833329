/// Pixels out of KTX2 textures with Basis Universal, as KHR_texture_basisu allows them.
#pragma once

#include <cstddef>
#include <span>

#include "core/image.h"

namespace candil {

/// Decodes the largest mip level to 8 bits a channel; `name` is left empty. Sizes are checked before anything is
/// decoded. Throws std::runtime_error with one line that does not name the file.
TextureImage decode_ktx2(std::span<const std::byte> encoded);

}  // namespace candil

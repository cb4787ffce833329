/// The layers of an EXR file out of its bytes.
#pragma once

#include <functional>
#include <span>

#include "io/image_file.h"

namespace candil {

/// As read_layers(), for the bytes of an EXR file. Throws std::runtime_error with one line that does not name the file.
LayeredImage decode_layers(std::span<const std::byte> encoded, const LayerChoice& choose);

}  // namespace candil

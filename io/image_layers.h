/// The layers of an EXR file out of its bytes.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "io/image_file.h"

namespace candil {

/// As read_layers(), for the bytes of an EXR file. Throws std::runtime_error with one line that does not name the file.
LayeredImage decode_layers(std::span<const std::byte> encoded, const LayerChoice& choose);
/// Of a file, which is read piece by piece: a hundred megabytes that need not be in memory.
LayeredImage decode_layers(const std::filesystem::path& path, const LayerChoice& choose);

}  // namespace candil

/// What has to be known of an AVIF file before it is decoded.
#pragma once

#include <cstddef>
#include <span>

namespace candil {

bool is_avif(std::span<const std::byte> encoded);

/// The library opens and decodes in one step, whatever the size. Throws std::runtime_error with one line unless every
/// size that the file declares, in the container and in the AV1 data, is one that is decoded; for files that want
/// another decoder than that of AV1; and for pictures put together of several.
void check_avif(std::span<const std::byte> encoded);

}  // namespace candil

/// EXT_meshopt_compression and KHR_meshopt_compression: the bytes of a buffer view, compressed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "io/resource.h"

namespace candil {

/// False for a program that was built without meshoptimizer.
bool has_meshopt();

/// What the extension says of a view; modes and filters by the names that it gives them.
struct MeshoptView {
  std::span<const std::byte> compressed;
  std::size_t count = 0, stride = 0;  ///< Elements, and bytes of each.
  std::string mode, filter = "NONE";
  std::size_t view_bytes = 0, view_stride = 0;  ///< byteLength and byteStride (0: none) of the view itself.
};

/// Checks everything but the compressed bytes against the rules of the extensions, and that the view does not claim to
/// hold more than so many of them can. Throws InputError(name, place, ...). Afterwards count * stride is view_bytes.
void check_meshopt_view(const MeshoptView& view, const std::string& name, const std::string& place);

/// The bytes of a view that check_meshopt_view() has passed. Throws InputError(name, place, ...) for damaged data, and
/// for what the meshoptimizer that this program was built with does not know: version 1 of the vertex codec came with
/// 0.23, the filter COLOR with 0.25; both are of KHR_meshopt_compression alone.
Bytes decode_meshopt(const MeshoptView& view, const std::string& name, const std::string& place);

}  // namespace candil

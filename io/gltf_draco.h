/// KHR_draco_mesh_compression: the triangles and attributes of a primitive as one Draco stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/math.h"
#include "io/resource.h"

namespace candil {

/// False for a program that was built without Draco.
bool has_draco();

/// An attribute that is wanted of a stream, in the form that an accessor gives it.
struct DracoAttribute {
  std::uint32_t id = 0;    ///< Its unique id in the stream.
  int component_type = 0;  ///< Of glTF.
  std::size_t components = 0;
  std::string place;
};

struct DracoRequest {
  std::span<const std::byte> stream;
  std::vector<DracoAttribute> attributes;
  std::size_t vertex_count = 0;    ///< Must be exact.
  std::size_t most_triangles = 0;  ///< Encoders leave out degenerate ones.
  std::string place;
};

struct DracoGeometry {
  std::vector<Triangle> triangles;  ///< Each index below the vertex count.
  std::vector<Bytes> attributes;    ///< As requested, vertex after vertex without gaps.
};

/// Memory that decode_draco() may take for it, roughly.
std::size_t draco_bytes(const DracoRequest& request);

/// Throws InputError(name, place, ...) for streams that are damaged, of a bitstream other than 2.2, or that hold
/// something else than what is requested; before anything is allocated for what a stream claims to hold too much.
DracoGeometry decode_draco(const DracoRequest& request, const std::string& name);

}  // namespace candil

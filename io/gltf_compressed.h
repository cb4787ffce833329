/// Primitives that come as Draco streams, decoded: their accessors and indices then read as if they were plain.
#pragma once

#include <map>
#include <vector>

#include "core/math.h"
#include "io/resource.h"

namespace tinygltf {
struct Primitive;
}

namespace candil {

class GltfDocument;

class CompressedPrimitives {
 public:
  /// The elements of accessors[index], one after the other; null unless a stream holds them. Empty for indices, which
  /// triangles() has.
  const Bytes* accessor(int index) const;
  /// The triangles of a primitive; null unless they are in a stream.
  const std::vector<Triangle>* triangles(const tinygltf::Primitive& primitive) const;

 private:
  friend CompressedPrimitives decode_primitives(const GltfDocument& document);
  std::map<int, Bytes> accessors_;
  std::map<int, std::vector<Triangle>> triangles_;  // by the buffer view of the stream
};

/// Decodes all streams of the document in parallel. Nothing when this program has no Draco: files that do not require
/// it have plain accessors too. Throws InputError.
CompressedPrimitives decode_primitives(const GltfDocument& document);

}  // namespace candil

#include "io/gltf_compressed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>

#include "io/gltf_document.h"
#include "io/gltf_draco.h"
#include "io/gltf_tinygltf.h"

namespace candil {

namespace {

/// One stream; several primitives may share it.
struct Stream {
  int view = -1;
  DracoRequest request;
  std::vector<int> accessors;  // where each requested attribute goes
  std::vector<int> indices;    // accessors that have no bytes of their own
  DracoGeometry geometry;
  std::exception_ptr error;
};

const tinygltf::Value* draco_of(const tinygltf::Primitive& primitive) {
  const auto found = primitive.extensions.find("KHR_draco_mesh_compression");
  return found == primitive.extensions.end() ? nullptr : &found->second;
}

class StreamCollector {
 public:
  explicit StreamCollector(const GltfDocument& document) : document_(document), model_(document.model()) {}

  std::vector<Stream> collect() {
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
      for (std::size_t p = 0; p < model_.meshes[m].primitives.size(); ++p) {
        const tinygltf::Primitive& primitive = model_.meshes[m].primitives[p];
        const tinygltf::Value* draco = draco_of(primitive);
        if (draco != nullptr) {
          add(primitive, *draco, "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) + "]");
        }
      }
    }
    return std::move(streams_);
  }

 private:
  void add(const tinygltf::Primitive& primitive, const tinygltf::Value& draco, const std::string& place) {
    const bool is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    if (!is_strip && primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
      document_.fail(place + ".mode", "must be TRIANGLES or TRIANGLE_STRIP with KHR_draco_mesh_compression");
    }
    const auto positions = primitive.attributes.find("POSITION");
    if (positions == primitive.attributes.end()) return;  // not shown
    const std::string draco_place = place + ".extensions.KHR_draco_mesh_compression";
    const std::size_t vertices = model_.accessors[std::size_t(positions->second)].count;
    const std::size_t corners =
        primitive.indices < 0 ? vertices : model_.accessors[std::size_t(primitive.indices)].count;
    if (vertices >= invalid_id || corners / 3 >= invalid_id) document_.fail(draco_place, "has too many vertices");
    Stream& stream = find(draco.Get("bufferView").GetNumberAsInt(), draco_place, vertices);
    stream.request.most_triangles = std::max(stream.request.most_triangles, is_strip ? corners : corners / 3);
    const bool is_bare = primitive.indices >= 0 && model_.accessors[std::size_t(primitive.indices)].bufferView < 0;
    if (is_bare) stream.indices.push_back(primitive.indices);
    const tinygltf::Value& attributes = draco.Get("attributes");
    for (const std::string& semantic : attributes.Keys()) {
      const auto found = primitive.attributes.find(semantic);
      if (found == primitive.attributes.end()) continue;
      add_attribute(stream, attributes.Get(semantic).GetNumberAsInt(), found->second,
                    draco_place + ".attributes." + printable(semantic));
    }
  }

  Stream& find(int view, const std::string& place, std::size_t vertices) {
    const auto [entry, is_new] = ids_.try_emplace(view, streams_.size());
    if (is_new) {
      Stream& stream = streams_.emplace_back();
      stream.view = view;
      stream.request.stream = document_.buffer_view(std::size_t(view));
      stream.request.place = place;
      stream.request.vertex_count = vertices;
    }
    Stream& stream = streams_[entry->second];
    if (stream.request.vertex_count != vertices) {
      document_.fail(place, "shares its stream with a primitive that has another number of vertices");
    }
    return stream;
  }

  void add_attribute(Stream& stream, int id, int accessor_index, const std::string& place) {
    const tinygltf::Accessor& accessor = model_.accessors[std::size_t(accessor_index)];
    if (accessor.count != stream.request.vertex_count) {
      document_.fail(place, "accessor " + std::to_string(accessor_index) + " has " + std::to_string(accessor.count) +
                                " elements, POSITION has " + std::to_string(stream.request.vertex_count));
    }
    const bool is_matrix = accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
                           accessor.type == TINYGLTF_TYPE_MAT4;
    if (is_matrix) document_.fail(place, "accessor " + std::to_string(accessor_index) + " must not hold matrices");
    const auto same = [&](std::size_t i) {
      return stream.accessors[i] == accessor_index && stream.request.attributes[i].id == std::uint32_t(id);
    };
    for (std::size_t i = 0; i < stream.accessors.size(); ++i) {
      if (same(i)) return;
    }
    stream.accessors.push_back(accessor_index);
    stream.request.attributes.push_back({std::uint32_t(id), accessor.componentType,
                                         std::size_t(tinygltf::GetNumComponentsInType(accessor.type)), place});
  }

  const GltfDocument& document_;
  const tinygltf::Model& model_;
  std::map<int, std::size_t> ids_;  // of streams_, by their view
  std::vector<Stream> streams_;
};

/// A stream of a few bytes can stand for any number of triangles.
void check_expansion(const GltfDocument& document, const std::vector<Stream>& streams) {
  constexpr std::size_t least = std::size_t{1} << 30, factor = 256;
  std::size_t bytes_left = std::max(least, factor * document.total_bytes());
  for (const Stream& stream : streams) {
    const std::size_t bytes = draco_bytes(stream.request);
    if (bytes > bytes_left) {
      document.fail(stream.request.place, "expands to far more geometry than the file has bytes for");
    }
    bytes_left -= bytes;
  }
}

/// Without a decoder, primitives need the values that may stand beside their streams; zeros would be shown otherwise.
void check_plain_accessors(const GltfDocument& document) {
  const tinygltf::Model& model = document.model();
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
      const auto positions = primitive.attributes.find("POSITION");
      if (draco_of(primitive) == nullptr || positions == primitive.attributes.end()) continue;
      if (model.accessors[std::size_t(positions->second)].bufferView >= 0) continue;
      DracoRequest request;
      request.place = "meshes[" + std::to_string(m) + "].primitives[" + std::to_string(p) +
                      "].extensions.KHR_draco_mesh_compression";
      decode_draco(request, document.name());  // which says what is missing
    }
  }
}

}  // namespace

const Bytes* CompressedPrimitives::accessor(int index) const {
  const auto found = accessors_.find(index);
  return found == accessors_.end() ? nullptr : &found->second;
}

const std::vector<Triangle>* CompressedPrimitives::triangles(const tinygltf::Primitive& primitive) const {
  const tinygltf::Value* draco = triangles_.empty() ? nullptr : draco_of(primitive);
  if (draco == nullptr) return nullptr;
  const auto found = triangles_.find(draco->Get("bufferView").GetNumberAsInt());
  return found == triangles_.end() ? nullptr : &found->second;
}

CompressedPrimitives decode_primitives(const GltfDocument& document) {
  CompressedPrimitives result;
  if (!has_draco()) {
    check_plain_accessors(document);
    return result;
  }
  std::vector<Stream> streams = StreamCollector(document).collect();
  check_expansion(document, streams);
  tbb::parallel_for(std::size_t{0}, streams.size(), [&](std::size_t i) {
    Stream& stream = streams[i];
    try {
      stream.geometry = decode_draco(stream.request, document.name());
    } catch (...) {
      stream.error = std::current_exception();
    }
  });
  for (Stream& stream : streams) {
    if (stream.error) std::rethrow_exception(stream.error);
    for (std::size_t a = 0; a < stream.accessors.size(); ++a) {
      const auto [entry, is_new] = result.accessors_.try_emplace(stream.accessors[a]);
      Bytes& bytes = stream.geometry.attributes[a];
      if (!is_new && entry->second != bytes) {
        document.fail(stream.request.attributes[a].place,
                      "accessor " + std::to_string(stream.accessors[a]) + " has other values in another Draco stream");
      }
      entry->second = std::move(bytes);
    }
    for (const int indices : stream.indices) result.accessors_.try_emplace(indices);
    result.triangles_[stream.view] = std::move(stream.geometry.triangles);
  }
  return result;
}

}  // namespace candil

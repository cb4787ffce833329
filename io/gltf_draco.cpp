#include "io/gltf_draco.h"

#include <cstring>
#include <exception>
#include <type_traits>

#include "io/error.h"

#ifdef CANDIL_HAS_DRACO
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/config/decoder_options.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/decoder_buffer.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#endif

namespace candil {

namespace {

std::size_t component_bytes(int type) { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }

/// Of the attributes that are requested.
std::size_t vertex_bytes(const DracoRequest& request) {
  std::size_t bytes = 0;
  for (const DracoAttribute& attribute : request.attributes) {
    bytes += attribute.components * component_bytes(attribute.component_type);
  }
  return bytes;
}

}  // namespace

std::size_t draco_bytes(const DracoRequest& request) {
  // Tables of corners, faces, our copy; attributes as integers, as values, our copy.
  constexpr std::size_t triangle_bytes = 120;
  return request.most_triangles * triangle_bytes + request.vertex_count * 3 * (vertex_bytes(request) + 16);
}

#ifdef CANDIL_HAS_DRACO

namespace {

/// Draco sizes its tables by the numbers at the head of a stream. This looks at them first, between the steps of the
/// library's own decoder.
template <class Decoder>
class BoundedDecoder final : public Decoder {
 public:
  explicit BoundedDecoder(const DracoRequest& request) : request_(request) {}

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    std::uint32_t first = 0, second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    constexpr bool is_edgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
    const std::size_t triangles = is_edgebreaker ? second : first, vertices = is_edgebreaker ? first : second;
    return vertices <= request_.vertex_count && triangles <= request_.most_triangles && Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    std::size_t bytes = 0;
    for (int a = 0; a < cloud.num_attributes(); ++a) {
      const draco::PointAttribute& attribute = *cloud.attribute(a);
      bytes += std::size_t(attribute.num_components()) * std::size_t(draco::DataTypeLength(attribute.data_type()));
    }
    // There may be attributes that nobody asked for, and wider types than those of the accessors.
    return cloud.num_points() <= request_.vertex_count && bytes <= 4 * vertex_bytes(request_) + 64 &&
           Decoder::DecodeAllAttributes();
  }

 private:
  const DracoRequest& request_;
};

class StreamReader {
 public:
  StreamReader(const DracoRequest& request, const std::string& name) : request_(request), name_(name) {}

  DracoGeometry read() {
    decode();
    if (mesh_.num_points() != request_.vertex_count) {
      fail("has " + std::to_string(mesh_.num_points()) + " vertices, the accessors have " +
           std::to_string(request_.vertex_count));
    }
    DracoGeometry geometry;
    geometry.triangles = read_triangles();
    for (const DracoAttribute& attribute : request_.attributes) {
      geometry.attributes.push_back(read_attribute(attribute));
    }
    return geometry;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(name_, request_.place, "the Draco stream " + message);
  }

  void decode() {
    draco::DracoHeader header{};
    draco::DecoderBuffer buffer = make_buffer();
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) fail("is damaged");
    if (header.encoder_type != draco::TRIANGULAR_MESH) fail("does not hold a mesh");
    // Other versions have other numbers where BoundedDecoder looks.
    if (header.version_major != 2 || header.version_minor != 2) {
      fail("is of version " + std::to_string(header.version_major) + "." + std::to_string(header.version_minor) +
           ", the extension has 2.2");
    }
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
      decode_with<draco::MeshEdgebreakerDecoder>();
    } else if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
      decode_with<draco::MeshSequentialDecoder>();
    } else {
      fail("has an unknown encoding");
    }
  }

  template <class Decoder>
  void decode_with() {
    draco::DecoderBuffer buffer = make_buffer();
    const draco::DecoderOptions options;
    BoundedDecoder<Decoder> decoder(request_);
    bool is_decoded = false;
    try {
      is_decoded = decoder.Decode(options, &buffer, &mesh_).ok();
    } catch (const std::exception&) {  // of the standard library, for absurd sizes
    }
    if (!is_decoded) fail("is damaged, or holds more than the accessors say");
  }

  draco::DecoderBuffer make_buffer() const {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(request_.stream.data()), request_.stream.size());
    return buffer;
  }

  std::vector<Triangle> read_triangles() const {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh_.num_faces());
    for (std::uint32_t f = 0; f < mesh_.num_faces(); ++f) {
      const draco::Mesh::Face& face = mesh_.face(draco::FaceIndex(f));
      const Triangle triangle(face[0].value(), face[1].value(), face[2].value());
      for (int c = 0; c < 3; ++c) {
        if (triangle[c] >= request_.vertex_count) fail("has a triangle beyond its last vertex");
      }
      triangles.push_back(triangle);
    }
    return triangles;
  }

  Bytes read_attribute(const DracoAttribute& wanted) const {
    const draco::PointAttribute* attribute = mesh_.GetAttributeByUniqueId(wanted.id);
    if (attribute == nullptr) {
      throw InputError(name_, wanted.place, "the Draco stream has no attribute " + std::to_string(wanted.id));
    }
    if (std::size_t(attribute->num_components()) != wanted.components) {
      throw InputError(name_, wanted.place,
                       "has " + std::to_string(attribute->num_components()) +
                           " components in the Draco stream, the accessor has " + std::to_string(wanted.components));
    }
    switch (wanted.component_type) {
      case 5120:
        return convert<std::int8_t>(*attribute, wanted);
      case 5121:
        return convert<std::uint8_t>(*attribute, wanted);
      case 5122:
        return convert<std::int16_t>(*attribute, wanted);
      case 5123:
        return convert<std::uint16_t>(*attribute, wanted);
      case 5125:
        return convert<std::uint32_t>(*attribute, wanted);
      default:
        return convert<float>(*attribute, wanted);
    }
  }

  template <class Component>
  Bytes convert(const draco::PointAttribute& attribute, const DracoAttribute& wanted) const {
    if (!attribute.is_mapping_identity() && attribute.indices_map_size() < request_.vertex_count) fail("is damaged");
    std::vector<Component> element(wanted.components);
    const std::size_t size = element.size() * sizeof(Component);
    Bytes bytes(size * request_.vertex_count);
    for (std::size_t v = 0; v < request_.vertex_count; ++v) {
      const draco::AttributeValueIndex value = attribute.mapped_index(draco::PointIndex(std::uint32_t(v)));
      const bool is_there = value.value() < attribute.size();
      if (!is_there || !attribute.ConvertValue<Component>(value, std::int8_t(element.size()), element.data())) {
        throw InputError(name_, wanted.place,
                         "vertex " + std::to_string(v) + " of the Draco stream does not fit the accessor");
      }
      std::memcpy(bytes.data() + v * size, element.data(), size);
    }
    return bytes;
  }

  const DracoRequest& request_;
  const std::string& name_;
  draco::Mesh mesh_;
};

}  // namespace

bool has_draco() { return true; }

DracoGeometry decode_draco(const DracoRequest& request, const std::string& name) {
  return StreamReader(request, name).read();
}

#else

bool has_draco() { return false; }

DracoGeometry decode_draco(const DracoRequest& request, const std::string& name) {
  throw InputError(name, request.place, "this program was built without Draco (Debian and Ubuntu: libdraco-dev)");
}

#endif

}  // namespace candil

// KHR_draco_mesh_compression, with streams made by Draco's own encoder without quantisation: what comes out is what
// went in. Edgebreaker reorders vertices and triangles, so meshes are compared as sets of corners.
#ifdef CANDIL_HAS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

constexpr std::uint32_t side = 7;
constexpr std::size_t vertex_count = side * side;

/// A bent sheet with normals, uvs and colours.
struct Sheet {
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint8_t> colors;
  std::vector<std::uint16_t> indices;

  Sheet() {
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        const auto u = static_cast<float>(x), v = static_cast<float>(y);
        positions.insert(positions.end(), {0.25f * u, 0.5f * v, 0.3f * std::sin(u)});
        normals.insert(normals.end(), {0, 0.6f, 0.8f});
        uvs.insert(uvs.end(), {u / 6, v / 6});
        colors.insert(colors.end(), {std::uint8_t(10 * x), std::uint8_t(20 * y), 200, 255});
        if (x + 1 == side || y + 1 == side) continue;
        const auto a = static_cast<std::uint16_t>(y * side + x);
        const auto b = std::uint16_t(a + 1), c = std::uint16_t(a + side), d = std::uint16_t(c + 1);
        indices.insert(indices.end(), {a, b, c, b, d, c});
      }
    }
  }
};

template <typename T>
std::uint32_t add_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, draco::DataType data_type,
                            const std::vector<T>& values, bool is_normalized = false) {
  const std::size_t components = values.size() / vertex_count;
  draco::GeometryAttribute description;
  description.Init(type, nullptr, std::uint8_t(components), data_type, is_normalized,
                   std::int64_t(components * sizeof(T)), 0);
  const int id = mesh.AddAttribute(description, true, vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &values[v * components]);
  }
  return mesh.attribute(id)->unique_id();
}

struct Encoded {
  std::vector<std::byte> stream;
  std::uint32_t position = 0, normal = 0, uv = 0, color = 0;  // unique ids
};

Encoded encode(const Sheet& sheet, int method, bool has_uvs = true) {
  draco::Mesh mesh;
  mesh.set_num_points(vertex_count);
  Encoded encoded;
  encoded.position = add_attribute(mesh, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, sheet.positions);
  encoded.normal = add_attribute(mesh, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, sheet.normals);
  if (has_uvs) encoded.uv = add_attribute(mesh, draco::GeometryAttribute::TEX_COORD, draco::DT_FLOAT32, sheet.uvs);
  encoded.color = add_attribute(mesh, draco::GeometryAttribute::COLOR, draco::DT_UINT8, sheet.colors, true);
  for (std::size_t i = 0; i < sheet.indices.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(sheet.indices[i]), draco::PointIndex(sheet.indices[i + 1]),
                  draco::PointIndex(sheet.indices[i + 2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
  encoded.stream.assign(bytes.begin(), bytes.end());
  return encoded;
}

/// An accessor that gets its elements from a stream.
void add_bare_accessor(GltfSample& sample, int component_type, const char* type, std::size_t count,
                       const std::string& members = {}) {
  sample.accessors.push_back(R"({"componentType":)" + std::to_string(component_type) + R"(,"type":")" + type +
                             R"(","count":)" + std::to_string(count) + members + "}");
}

constexpr const char* draco_required =
    R"(,"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"])";

/// Accessors 0 to 3 are positions, normals, colours, indices.
GltfSample compressed_sample(const Encoded& encoded, std::size_t index_count, const std::string& members = {}) {
  GltfSample sample;
  sample.root = draco_required;
  const int view = sample.add_view(encoded.stream);
  add_bare_accessor(sample, gl_float, "VEC3", vertex_count);
  add_bare_accessor(sample, gl_float, "VEC3", vertex_count);
  add_bare_accessor(sample, gl_unsigned_byte, "VEC4", vertex_count, ",\"normalized\":true");
  add_bare_accessor(sample, gl_unsigned_short, "SCALAR", index_count);
  add_bare_accessor(sample, gl_float, "VEC2", vertex_count);
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"COLOR_0":2,"TEXCOORD_0":4},"indices":3)" +
                   members + R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" + std::to_string(view) +
                   R"(,"attributes":{"POSITION":)" + std::to_string(encoded.position) + R"(,"NORMAL":)" +
                   std::to_string(encoded.normal) + R"(,"COLOR_0":)" + std::to_string(encoded.color) +
                   R"(,"TEXCOORD_0":)" + std::to_string(encoded.uv) + "}}}}]}"};
  sample.nodes = {R"({"mesh":0})"};
  return sample;
}

GltfSample plain_sample(const Sheet& sheet) {
  GltfSample sample;
  sample.add_accessor(gl_float, "VEC3", vertex_count, sheet.positions);
  sample.add_accessor(gl_float, "VEC3", vertex_count, sheet.normals);
  sample.add_accessor(gl_unsigned_byte, "VEC4", vertex_count, sheet.colors, ",\"normalized\":true");
  sample.add_accessor(gl_unsigned_short, "SCALAR", sheet.indices.size(), sheet.indices);
  sample.add_accessor(gl_float, "VEC2", vertex_count, sheet.uvs);
  sample.meshes = {
      R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"COLOR_0":2,"TEXCOORD_0":4},"indices":3}]})"};
  sample.nodes = {R"({"mesh":0})"};
  return sample;
}

using Corner = std::array<float, 12>;

/// Triangles by all that their corners have, sorted, each from its least corner on.
std::vector<std::array<Corner, 3>> corners_of(const LoadedScene& loaded) {
  std::vector<std::array<Corner, 3>> all;
  const Mesh& mesh = loaded.scene.meshes.at(0);
  for (const Triangle t : mesh.triangles) {
    std::array<Corner, 3> triangle;
    for (int c = 0; c < 3; ++c) {
      const Vec3 p = mesh.positions[t[c]], n = mesh.normals.at(t[c]);
      const Vec2 uv = mesh.uvs[0].at(t[c]);
      const Vec4 color = mesh.colors.at(t[c]);
      triangle[std::size_t(c)] = {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y, color.x, color.y, color.z, color.w};
    }
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    all.push_back(triangle);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(GltfDraco, EqualsPlain) {
  const Sheet sheet;
  const auto expected = corners_of(load_sample(plain_sample(sheet)));
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const LoadedScene loaded = load_sample(compressed_sample(encode(sheet, method), sheet.indices.size()));
    EXPECT_EQ(corners_of(loaded), expected) << "method " << method;
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

// "If additional attributes are defined in primitive's attributes, but not defined in KHR_draco_mesh_compression's
// attributes, then the loader must process the additional attributes as usual." Sequential coding keeps the order.
TEST(GltfDraco, OtherAttributesArePlain) {
  const Sheet sheet;
  GltfSample sample = compressed_sample(encode(sheet, draco::MESH_SEQUENTIAL_ENCODING, false), sheet.indices.size());
  sample.accessors.pop_back();
  sample.add_accessor(gl_float, "VEC2", vertex_count, sheet.uvs);
  std::string& mesh = sample.meshes[0];
  const std::size_t at = mesh.rfind(",\"TEXCOORD_0\"");
  mesh.erase(at, mesh.find('}', at) - at);
  EXPECT_EQ(corners_of(load_sample(sample)), corners_of(load_sample(plain_sample(sheet))));
}

// A stream holds triangles whatever the mode of its primitive says.
TEST(GltfDraco, StripsAreTheTrianglesOfTheStream) {
  const Sheet sheet;
  const GltfSample sample =
      compressed_sample(encode(sheet, draco::MESH_EDGEBREAKER_ENCODING), sheet.indices.size(), ",\"mode\":5");
  EXPECT_EQ(corners_of(load_sample(sample)), corners_of(load_sample(plain_sample(sheet))));
  EXPECT_EQ(load_error(compressed_sample(encode(sheet, draco::MESH_EDGEBREAKER_ENCODING), sheet.indices.size(),
                                         ",\"mode\":1")),
            "model.gltf: meshes[0].primitives[0].mode: must be TRIANGLES or TRIANGLE_STRIP with "
            "KHR_draco_mesh_compression");
}

TEST(GltfDraco, TwoPrimitivesMayShareAStream) {
  const Sheet sheet;
  GltfSample sample = compressed_sample(encode(sheet, draco::MESH_EDGEBREAKER_ENCODING), sheet.indices.size());
  sample.meshes.push_back(sample.meshes[0]);
  sample.nodes.push_back(R"({"mesh":1})");
  const Scene scene = load_sample(sample).scene;
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].positions, scene.meshes[1].positions);
  EXPECT_EQ(scene.meshes[0].triangles, scene.meshes[1].triangles);
}

TEST(GltfDraco, MismatchesAreNamed) {
  const Sheet sheet;
  const Encoded encoded = encode(sheet, draco::MESH_SEQUENTIAL_ENCODING);
  const std::string place = "model.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
  const std::string more = place + ": the Draco stream is damaged, or holds more than the accessors say";
  const GltfSample good = compressed_sample(encoded, sheet.indices.size());

  EXPECT_EQ(load_error(compressed_sample(encoded, sheet.indices.size() - 3)), more) << "fewer indices than triangles";
  GltfSample sample = good;
  for (std::string& accessor : sample.accessors) {
    const std::size_t at = accessor.find("\"count\":49");
    if (at != std::string::npos) accessor.replace(at, 10, "\"count\":48");
  }
  EXPECT_EQ(load_error(sample), more) << "fewer vertices";
  for (std::string& accessor : sample.accessors) {
    const std::size_t at = accessor.find("\"count\":48");
    if (at != std::string::npos) accessor.replace(at, 10, "\"count\":50");
  }
  EXPECT_EQ(load_error(sample), place + ": the Draco stream has 49 vertices, the accessors have 50");

  sample = good;
  sample.accessors[4].replace(sample.accessors[4].find("VEC2"), 4, "VEC3");
  EXPECT_EQ(load_error(sample),
            place + ".attributes.TEXCOORD_0: has 2 components in the Draco stream, the accessor has 3");
  Encoded other = encoded;
  other.normal = 99;
  EXPECT_EQ(load_error(compressed_sample(other, sheet.indices.size())),
            place + ".attributes.NORMAL: the Draco stream has no attribute 99");
  other.normal = encoded.normal;
  other.stream[6] = std::byte{1};  // 2.1
  EXPECT_EQ(load_error(compressed_sample(other, sheet.indices.size())),
            place + ": the Draco stream is of version 2.1, the extension has 2.2");
}

// The accessors claim what a stream of a thousand bytes could never be worth.
TEST(GltfDraco, AbsurdCountsAreRefused) {
  const Sheet sheet;
  GltfSample sample = compressed_sample(encode(sheet, draco::MESH_EDGEBREAKER_ENCODING), 3'000'000'000);
  EXPECT_NE(load_error(sample).find("expands to far more geometry"), std::string::npos) << load_error(sample);
}

// Whatever the bytes, there is a scene or one line of an error.
TEST(GltfDraco, DamagedBytesNeverCrash) {
  const Sheet sheet;
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Encoded whole = encode(sheet, method);
    int errors = 0;
    for (std::size_t i = 0; i < whole.stream.size(); ++i) {
      Encoded damaged = whole;
      damaged.stream[i] ^= std::byte(1u << i % 8);
      errors += load_error(compressed_sample(damaged, sheet.indices.size())).empty() ? 0 : 1;
    }
    EXPECT_GT(errors, 0);
    for (std::size_t length = 0; length < whole.stream.size(); length += 3) {
      Encoded cut = whole;
      cut.stream.resize(length);
      EXPECT_NE(load_error(compressed_sample(cut, sheet.indices.size())), "") << length;
    }
  }
}

}  // namespace
}  // namespace candil::test
#else
#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

// Streams are not looked at without Draco, so that any bytes do.
GltfSample compressed_triangle() {
  GltfSample sample;
  const std::vector<std::uint8_t> stream = {'D', 'R', 'A', 'C', 'O'};
  const int view = sample.add_view(std::as_bytes(std::span(stream)));
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  sample.add_triangle("", R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" + std::to_string(view) +
                              R"(,"attributes":{"POSITION":0}}})");
  sample.root = R"(,"extensionsUsed":["KHR_draco_mesh_compression"])";
  return sample;
}

TEST(WithoutDraco, PlainAccessorsAreShown) {
  const LoadedScene loaded = load_sample(compressed_triangle());
  EXPECT_EQ(loaded.scene.meshes.at(0).positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  ASSERT_EQ(loaded.not_honoured.size(), 1u);
  EXPECT_EQ(loaded.not_honoured[0].reason, "unavailable: this build has no libdraco-dev");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{
                                 "extension KHR_draco_mesh_compression is ignored: this build has no libdraco-dev"});
}

TEST(WithoutDraco, FilesThatNeedItAreRefusedByThePackage) {
  GltfSample sample = compressed_triangle();
  sample.accessors[0] = R"({"componentType":5126,"type":"VEC3","count":3})";
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: this program was built without "
            "Draco (Debian and Ubuntu: libdraco-dev)");
  sample.root += R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
  EXPECT_NE(load_error(sample).find("this build has no libdraco-dev"), std::string::npos);
}

}  // namespace
}  // namespace candil::test
#endif

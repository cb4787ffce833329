// EXT_meshopt_compression and KHR_meshopt_compression, with streams made by meshoptimizer's own encoders: what comes
// out is what went in. Index codecs keep triangles and their order, but may begin a triangle at another corner.
#ifdef CANDIL_HAS_MESHOPTIMIZER
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

using Stream = std::vector<std::byte>;

constexpr int side = 9;  // vertices along each edge of the sheet

std::vector<Vec3> sheet_positions() {
  std::vector<Vec3> positions;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      positions.emplace_back(0.25f * u, 0.5f * v, 0.125f * u * v);
    }
  }
  return positions;
}

std::vector<std::uint32_t> sheet_indices() {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      indices.insert(indices.end(), {a, b, c, b, d, c});
    }
  }
  return indices;
}

Stream encode_vertices(const void* vertices, std::size_t count, std::size_t stride) {
  meshopt_encodeVertexVersion(0);
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, stride));
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

Stream encode_triangles(const std::vector<std::uint32_t>& indices) {
  std::vector<unsigned char> bytes(meshopt_encodeIndexBufferBound(indices.size(), side * side));
  bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

Stream encode_sequence(const std::vector<std::uint32_t>& indices) {
  std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(indices.size(), side * side));
  bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

/// A glTF file whose compressed views belong to a second buffer that has no bytes.
struct CompressedSample : GltfSample {
  std::string extension = "EXT_meshopt_compression", mark = R"("fallback":true)";
  std::size_t fallback_bytes = 0;

  int add_compressed(const Stream& stream, std::size_t count, std::size_t stride, const std::string& mode,
                     const std::string& filter = {}) {
    const int view = add_view(stream);
    const std::size_t offset = buffer.size() - stream.size(), bytes = count * stride;
    views.back() = R"({"buffer":1,"byteOffset":)" + std::to_string(fallback_bytes) + R"(,"byteLength":)" +
                   std::to_string(bytes) + R"(,"extensions":{")" + extension + R"(":{"buffer":0,"byteOffset":)" +
                   std::to_string(offset) + R"(,"byteLength":)" + std::to_string(stream.size()) + R"(,"byteStride":)" +
                   std::to_string(stride) + R"(,"count":)" + std::to_string(count) + R"(,"mode":")" + mode + "\"" +
                   (filter.empty() ? "" : R"(,"filter":")" + filter + "\"") + "}}}";
    fallback_bytes += bytes;
    return view;
  }

  std::string text() const {
    std::string text = json();
    const std::string placeholder = R"(,{"byteLength":)" + std::to_string(fallback_bytes) + R"(,"extensions":{")" +
                                    extension + R"(":{)" + mark + "}}}";
    return text.insert(text.find("],\"bufferViews\""), placeholder);
  }
};

CompressedSample compressed_sheet(const std::string& extension, bool is_sequence = false) {
  const std::vector<Vec3> positions = sheet_positions();
  const std::vector<std::uint32_t> indices = sheet_indices();
  CompressedSample sample;
  sample.extension = extension;
  sample.root = R"(,"extensionsUsed":[")" + extension + R"("],"extensionsRequired":[")" + extension + R"("])";
  sample.add_accessor_to_view(sample.add_compressed(encode_vertices(positions.data(), positions.size(), 12),
                                                    positions.size(), 12, "ATTRIBUTES"),
                              gl_float, "VEC3", positions.size());
  const int view = is_sequence ? sample.add_compressed(encode_sequence(indices), indices.size(), 4, "INDICES")
                               : sample.add_compressed(encode_triangles(indices), indices.size(), 4, "TRIANGLES");
  sample.add_accessor_to_view(view, gl_unsigned_int, "SCALAR", indices.size());
  sample.add_triangle("", ",\"indices\":1");
  return sample;
}

Triangle from_least_corner(Triangle t) {
  while (t.x > t.y || t.x > t.z) t = {t.y, t.z, t.x};
  return t;
}

void expect_sheet(const LoadedScene& loaded) {
  ASSERT_EQ(loaded.scene.meshes.size(), 1u);
  const Mesh& mesh = loaded.scene.meshes[0];
  EXPECT_EQ(mesh.positions, sheet_positions());
  const std::vector<std::uint32_t> indices = sheet_indices();
  ASSERT_EQ(mesh.triangles.size(), indices.size() / 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle expected(indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]);
    EXPECT_EQ(from_least_corner(mesh.triangles[t]), from_least_corner(expected)) << "triangle " << t;
  }
}

TEST(GltfMeshopt, EqualsPlain) {
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    for (const bool is_sequence : {false, true}) {
      SCOPED_TRACE(std::string(extension) + (is_sequence ? " INDICES" : " TRIANGLES"));
      const LoadedScene loaded = load_text(compressed_sheet(extension, is_sequence).text());
      expect_sheet(loaded);
      EXPECT_TRUE(loaded.warnings.empty());
    }
  }
}

TEST(GltfMeshopt, PlaceholderNeedsNoMark) {
  CompressedSample sample = compressed_sheet("EXT_meshopt_compression");
  sample.mark.clear();
  expect_sheet(load_text(sample.text()));
}

// Octahedral coordinates of 8 bits are off by at most half a step of 1/127 each, and so are the components of what is
// decoded: less than 1/40 in all.
TEST(GltfMeshopt, OctahedralNormals) {
  std::vector<Vec4> normals;
  for (int i = 0; i < side * side; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / (side * side), angle = 2.4f * static_cast<float>(i);
    const float r = std::sqrt(1 - z * z);
    normals.emplace_back(r * std::cos(angle), r * std::sin(angle), z, 0);
  }
  std::vector<std::byte> encoded(4 * normals.size());
  meshopt_encodeFilterOct(encoded.data(), normals.size(), 4, 8, &normals[0].x);
  CompressedSample sample = compressed_sheet("EXT_meshopt_compression");
  const int view = sample.add_compressed(encode_vertices(encoded.data(), normals.size(), 4), normals.size(), 4,
                                         "ATTRIBUTES", "OCTAHEDRAL");
  // KHR_mesh_quantization: three bytes of every four.
  sample.views.back().insert(1, "\"byteStride\":4,");
  sample.add_accessor_to_view(view, gl_byte, "VEC3", normals.size(), ",\"normalized\":true");
  sample.meshes[0] = R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":2},"indices":1}]})";
  const Scene scene = load_text(sample.text()).scene;
  ASSERT_EQ(scene.meshes.at(0).normals.size(), normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_LT(glm::distance(scene.meshes[0].normals[i], Vec3(normals[i])), 1 / 40.0f) << i;
  }
}

// Appendix B of the extension: 24 bits of signed mantissa times two to the power of the signed upper 8 bits.
TEST(GltfMeshopt, ExponentialPositions) {
  const std::vector<Vec3> positions = sheet_positions();
  std::vector<std::uint32_t> encoded;
  for (const Vec3 p : positions) {
    for (int c = 0; c < 3; ++c) {
      const auto mantissa = static_cast<std::int32_t>(p[c] * 8);                             // all are multiples of 1/8
      encoded.push_back((static_cast<std::uint32_t>(mantissa) & 0xffffff) | (0xfdu << 24));  // 2^-3
    }
  }
  CompressedSample sample = compressed_sheet("KHR_meshopt_compression");
  const int view = sample.add_compressed(encode_vertices(encoded.data(), positions.size(), 12), positions.size(), 12,
                                         "ATTRIBUTES", "EXPONENTIAL");
  sample.add_accessor_to_view(view, gl_float, "VEC3", positions.size());
  sample.meshes[0] = R"({"primitives":[{"attributes":{"POSITION":2},"indices":1}]})";
  expect_sheet(load_text(sample.text()));
}

// 16 bits for three components, the fourth from the length: errors below 1e-4.
TEST(GltfMeshopt, QuaternionsOfInstances) {
  std::vector<Vec4> rotations;
  for (int i = 0; i < 16; ++i) {
    const float angle = 0.37f * static_cast<float>(i);
    rotations.emplace_back(0, std::sin(angle), 0, std::cos(angle));
  }
  std::vector<std::byte> encoded(8 * rotations.size());
  meshopt_encodeFilterQuat(encoded.data(), rotations.size(), 8, 16, &rotations[0].x);
  CompressedSample sample = compressed_sheet("EXT_meshopt_compression");
  const int view = sample.add_compressed(encode_vertices(encoded.data(), rotations.size(), 8), rotations.size(), 8,
                                         "ATTRIBUTES", "QUATERNION");
  sample.add_accessor_to_view(view, gl_short, "VEC4", rotations.size(), ",\"normalized\":true");
  sample.nodes = {R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"ROTATION":2}}}})"};
  const Scene scene = load_text(sample.text()).scene;
  ASSERT_EQ(scene.instances.size(), rotations.size());
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    // A turn by 2 a about +Y takes +Z to (sin 2a, 0, cos 2a).
    const float angle = 2 * 0.37f * static_cast<float>(i);
    const Vec3 turned = scene.instances[i].to_world.vector(Vec3(0, 0, 1));
    EXPECT_LT(glm::distance(turned, Vec3(std::sin(angle), 0, std::cos(angle))), 1e-3f) << i;
  }
}

TEST(GltfMeshopt, NewerCodecsWorkOrNameTheVersionTheyNeed) {
  CompressedSample sample = compressed_sheet("KHR_meshopt_compression");
  const std::vector<std::uint32_t> color(side * side, 0xff008080u);
  sample.add_compressed(encode_vertices(color.data(), color.size(), 4), color.size(), 4, "ATTRIBUTES", "COLOR");
  const std::string error = load_error(sample.text());
  if (MESHOPTIMIZER_VERSION >= 250) {
    EXPECT_EQ(error, "");
  } else {
    EXPECT_NE(error.find("bufferViews[2].extensions.KHR_meshopt_compression: uses the filter COLOR, which needs "
                         "meshoptimizer 0.25 or newer; this program was built with 0."),
              std::string::npos)
        << error;
  }
  // The first byte of a stream has the version of its codec; nothing else of this one is of version 1.
  sample = compressed_sheet("KHR_meshopt_compression");
  ASSERT_EQ(sample.buffer.at(0), std::byte{0xA0});
  sample.buffer[0] = std::byte{0xA1};
  const std::string codec_error = load_error(sample.text());
  EXPECT_NE(codec_error.find(MESHOPTIMIZER_VERSION >= 230 ? "" : "needs meshoptimizer 0.23"), std::string::npos);
}

std::string error_after(const std::string& find, const std::string& replace) {
  std::string text = compressed_sheet("EXT_meshopt_compression").text();
  const std::size_t at = text.find(find);
  if (at == std::string::npos) return find + " is not there";
  return load_error(text.replace(at, find.size(), replace));
}

TEST(GltfMeshopt, BrokenRulesAreNamed) {
  const std::string first = "model.gltf: bufferViews[0].extensions.EXT_meshopt_compression.",
                    second = "model.gltf: bufferViews[1].extensions.EXT_meshopt_compression.";
  EXPECT_EQ(error_after(R"("byteStride":12)", R"("byteStride":10)"),
            first + "byteStride: must be 4, 8, ... or 256 in mode ATTRIBUTES, not 10");
  EXPECT_EQ(error_after(R"("count":81)", R"("count":80)"),
            first + "count: makes 960 bytes, the byteLength of the view is 972");
  EXPECT_EQ(error_after(R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTES","filter":"QUATERNION")"),
            first + "byteStride: of 12 does not go with the filter QUATERNION");
  EXPECT_EQ(error_after(R"("mode":"ATTRIBUTES")", R"("mode":"ATTRIBUTES","filter":"COLOR")"),
            first + "filter: \"COLOR\" is none of: NONE OCTAHEDRAL QUATERNION EXPONENTIAL");
  EXPECT_EQ(error_after(R"("mode":"TRIANGLES")", R"("mode":"TRIANGLES","filter":"EXPONENTIAL")"),
            second + "filter: must be NONE in mode TRIANGLES");
  EXPECT_EQ(error_after(R"("count":384)", R"("count":383)"),
            second + "count: must be a multiple of 3 in mode TRIANGLES, not 383");
  EXPECT_NE(error_after(R"("mode":"TRIANGLES")", R"("mode":"INDICES")").find("the compressed data is damaged"),
            std::string::npos);
  EXPECT_NE(error_after(R"({"buffer":1,)", R"({"buffer":1,"byteStride":16,)").find("that of the view is 16"),
            std::string::npos);
}

// What the encoder made of 972 bytes cannot stand for a thousand times as many.
TEST(GltfMeshopt, AbsurdSizesAreRefusedBeforeTheyAreAllocated) {
  std::string text = compressed_sheet("EXT_meshopt_compression").text();
  const auto replace = [&](const std::string& find, const std::string& by) {
    for (std::size_t at = text.find(find); at != std::string::npos; at = text.find(find, at + by.size())) {
      text.replace(at, find.size(), by);
    }
  };
  replace("\"count\":81", "\"count\":1000000000000");
  replace("\"byteLength\":972", "\"byteLength\":12000000000000");
  replace(R"({"byteLength":2508,)", R"({"byteLength":20000000000000,)");
  EXPECT_NE(load_error(text).find("byteLength: is too short for 12000000000000 bytes of elements"), std::string::npos)
      << load_error(text);
}

TEST(GltfMeshopt, PlainViewsOfABufferWithoutBytesAreErrors) {
  CompressedSample sample = compressed_sheet("EXT_meshopt_compression");
  sample.views.push_back(R"({"buffer":1,"byteLength":12})");
  EXPECT_EQ(load_error(sample.text()), "model.gltf: buffers[1]: has no uri and the file no binary chunk for it");
}

TEST(GltfMeshopt, ViewsMustFitIntoTheBufferThatTheyStandFor) {
  CompressedSample sample = compressed_sheet("EXT_meshopt_compression");
  sample.fallback_bytes -= 4;
  EXPECT_EQ(load_error(sample.text()), "model.gltf: bufferViews[1]: reads 4 bytes beyond buffer 1");
}

// Whatever the bytes, there is a scene or one line of an error.
TEST(GltfMeshopt, DamagedBytesNeverCrash) {
  const CompressedSample whole = compressed_sheet("EXT_meshopt_compression");
  int errors = 0;
  for (std::size_t i = 0; i < whole.buffer.size(); ++i) {
    CompressedSample damaged = whole;
    damaged.buffer[i] ^= std::byte(1u << i % 8);
    errors += load_error(damaged.text()).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 0);
  const std::vector<Vec3> positions = sheet_positions();
  const Stream stream = encode_vertices(positions.data(), positions.size(), 12);
  for (std::size_t length = 0; length < stream.size(); ++length) {
    CompressedSample cut = whole;
    cut.add_compressed(Stream(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(length)), positions.size(),
                       12, "ATTRIBUTES");
    EXPECT_NE(load_error(cut.text()), "") << length;
  }
}

}  // namespace
}  // namespace candil::test
#else
#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// A buffer that only compressed views refer to, as the extension has it.
std::string compressed_file(const std::string& more_of_buffer, const std::string& more_of_root) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_meshopt_compression"],"buffers":[{"byteLength":12)" +
         more_of_buffer + R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[{"buffer":0,
         "byteLength":12,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":4,"byteStride":4,"count":3,
         "mode":"ATTRIBUTES"}}}])" +
         more_of_root + "}";
}

TEST(WithoutMeshoptimizer, FallbackBuffersAreReadAndBareOnesRefusedByThePackage) {
  EXPECT_EQ(load_error(compressed_file(R"(,"uri":"data:;base64,AAAAAAAAAAAAAAAA")", "")), "");
  EXPECT_EQ(load_error(compressed_file("", "")),
            "model.gltf: buffers[0]: this program was built without meshoptimizer (Debian and Ubuntu: "
            "libmeshoptimizer-dev)");
  EXPECT_NE(load_error(compressed_file("", R"(,"extensionsRequired":["EXT_meshopt_compression"])"))
                .find("this build has no libmeshoptimizer-dev"),
            std::string::npos);
}

}  // namespace
}  // namespace candil::test
#endif

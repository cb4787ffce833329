#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// The uvs of the triangle's three vertices, from one accessor. uvs are kept as they are by the loader.
std::vector<Vec2> load_uvs(GltfSample sample) {
  const LoadedScene loaded = load_sample(sample);
  return loaded.scene.meshes.at(0).uvs[0];
}

template <class Component>
GltfSample sample_with_uvs(int component_type, const std::vector<Component>& values, bool is_normalized) {
  GltfSample sample;
  sample.add_triangle(",\"TEXCOORD_0\":1");
  sample.add_accessor<Component>(component_type, "VEC2", 3, values, is_normalized ? ",\"normalized\":true" : "");
  return sample;
}

TEST(GltfAccessor, ReadsFloats) {
  const auto uvs = load_uvs(sample_with_uvs<float>(gl_float, {0.25f, -3, 1e-20f, 2, 5, 6}, false));
  EXPECT_EQ(uvs, (std::vector<Vec2>{{0.25f, -3}, {1e-20f, 2}, {5, 6}}));
}

// Specification, section 3.11: c / 127 and c / 32767 clamped at -1 for signed types, c / 255 and c / 65535 for unsigned
// ones. Four-byte alignment of the elements (VEC2 of bytes) does not hold here, which the specification forbids and
// readers take.
TEST(GltfAccessor, NormalisesIntegers) {
  EXPECT_EQ(load_uvs(sample_with_uvs<std::uint8_t>(gl_unsigned_byte, {0, 255, 51, 102, 153, 204}, true)),
            (std::vector<Vec2>{{0, 1}, {0.2f, 0.4f}, {0.6f, 0.8f}}));
  EXPECT_EQ(load_uvs(sample_with_uvs<std::uint16_t>(gl_unsigned_short, {0, 65535, 13107, 26214, 39321, 52428}, true)),
            (std::vector<Vec2>{{0, 1}, {0.2f, 0.4f}, {0.6f, 0.8f}}));
  EXPECT_EQ(load_uvs(sample_with_uvs<std::int8_t>(gl_byte, {-128, -127, 127, 0, 1, -1}, true)),
            (std::vector<Vec2>{{-1, -1}, {1, 0}, {1 / 127.0f, -1 / 127.0f}}));
  EXPECT_EQ(load_uvs(sample_with_uvs<std::int16_t>(gl_short, {-32768, -32767, 32767, 0, 1, -1}, true)),
            (std::vector<Vec2>{{-1, -1}, {1, 0}, {1 / 32767.0f, -1 / 32767.0f}}));
}

TEST(GltfAccessor, ReadsPlainIntegersAsTheyAre) {
  EXPECT_EQ(load_uvs(sample_with_uvs<std::uint16_t>(gl_unsigned_short, {0, 1, 2, 3, 400, 65535}, false)),
            (std::vector<Vec2>{{0, 1}, {2, 3}, {400, 65535}}));
  EXPECT_EQ(load_uvs(sample_with_uvs<std::int8_t>(gl_byte, {0, -1, 2, -3, 4, -128}, false)),
            (std::vector<Vec2>{{0, -1}, {2, -3}, {4, -128}}));
}

// Positions of 8 and 16 bits (KHR_mesh_quantization), scaled by their node: 100 * 0.01 = 1.
TEST(GltfAccessor, ReadsQuantisedPositions) {
  GltfSample sample;
  sample.add_accessor<std::int16_t>(gl_short, "VEC3", 3, {0, 0, 0, 100, 0, 0, 0, -200, 0});
  sample.root = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  sample.add_triangle();
  sample.nodes = {R"({"mesh":0,"scale":[0.01,0.01,0.01]})"};
  const auto positions = load_sample(sample).scene.meshes.at(0).positions;
  ASSERT_EQ(positions.size(), 3u);
  EXPECT_FLOAT_EQ(positions[1].x, 1);
  EXPECT_FLOAT_EQ(positions[2].y, -2);
}

// Interleaved: position, then uv, 20 bytes a vertex; the last vertex need not be padded to the stride.
TEST(GltfAccessor, ReadsInterleavedAttributes) {
  GltfSample sample;
  const std::vector<float> values = {0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f};
  const int view = sample.add_view(std::as_bytes(std::span(values)), ",\"byteStride\":20");
  sample.add_accessor_to_view(view, gl_float, "VEC3", 3);
  sample.add_accessor_to_view(view, gl_float, "VEC2", 3, ",\"byteOffset\":12");
  sample.add_triangle(",\"TEXCOORD_0\":1");
  const Mesh mesh = load_sample(sample).scene.meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.uvs[0], (std::vector<Vec2>{{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}}));
}

TEST(GltfAccessor, SubstitutesSparseElements) {
  GltfSample sample = sample_with_uvs<float>(gl_float, {1, 1, 2, 2, 3, 3}, false);
  const std::vector<std::uint8_t> targets = {0, 2};
  const std::vector<float> values = {7, 8, 9, 10};
  const int indices = sample.add_view(std::as_bytes(std::span(targets)));
  const int view = sample.add_view(std::as_bytes(std::span(values)));
  std::string& accessor = sample.accessors[1];
  accessor.pop_back();
  accessor += ",\"sparse\":{\"count\":2,\"indices\":{\"componentType\":5121,\"bufferView\":" + std::to_string(indices) +
              "},\"values\":{\"bufferView\":" + std::to_string(view) + "}}}";
  EXPECT_EQ(load_uvs(sample), (std::vector<Vec2>{{7, 8}, {2, 2}, {9, 10}}));
}

TEST(GltfAccessor, SparseWithoutViewStartsFromZeros) {
  GltfSample sample;
  sample.add_triangle(",\"TEXCOORD_0\":1");
  const std::vector<std::uint16_t> targets = {1};
  const std::vector<float> values = {7, 8};
  const int indices = sample.add_view(std::as_bytes(std::span(targets)));
  const int view = sample.add_view(std::as_bytes(std::span(values)));
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC2","count":3,"sparse":{"count":1,)"
                             R"("indices":{"componentType":5123,"bufferView":)" +
                             std::to_string(indices) + R"(},"values":{"bufferView":)" + std::to_string(view) + "}}}");
  EXPECT_EQ(load_uvs(sample), (std::vector<Vec2>{{0, 0}, {7, 8}, {0, 0}}));

  sample.accessors[1].replace(sample.accessors[1].find("5123"), 4, "5125");  // now reads 4 bytes of 2
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].attributes.TEXCOORD_0: accessor 1 reads 2 bytes beyond buffer view 1");
}

// So do indices, which tinygltf by itself would not take: 0 0 0 becomes 0 1 2.
TEST(GltfAccessor, SparseIndicesWithoutViewStartFromZeros) {
  GltfSample sample;
  sample.add_triangle("", ",\"indices\":1");
  const std::vector<std::uint8_t> targets = {1, 2}, values = {1, 2};
  const int indices = sample.add_view(std::as_bytes(std::span(targets)));
  const int view = sample.add_view(std::as_bytes(std::span(values)));
  const std::string start = R"({"componentType":5121,"type":"SCALAR","count":3)";
  sample.accessors.push_back(start + R"(,"sparse":{"count":2,"indices":{"componentType":5121,"bufferView":)" +
                             std::to_string(indices) + R"(},"values":{"bufferView":)" + std::to_string(view) + "}}}");
  EXPECT_EQ(load_sample(sample).scene.meshes.at(0).triangles, (std::vector<Triangle>{{0, 1, 2}}));

  sample.accessors[1] = start + "}";
  EXPECT_EQ(load_error(sample), "") << "a triangle without area";
  sample.accessors[1].replace(sample.accessors[1].find("5121"), 4, "5126");
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].indices: accessor 1 must have unsigned integers for indices");
}

TEST(GltfAccessor, RefusesSparseIndexOutOfRange) {
  GltfSample sample;
  sample.add_triangle();
  const std::vector<std::uint8_t> targets = {3};
  const std::vector<float> values = {7, 8, 9};
  sample.add_view(std::as_bytes(std::span(targets)));
  sample.add_view(std::as_bytes(std::span(values)));
  sample.accessors[0].pop_back();
  sample.accessors[0] +=
      R"(,"sparse":{"count":1,"indices":{"componentType":5121,"bufferView":1},"values":{"bufferView":2}}})";
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].attributes.POSITION: accessor 0 has the sparse index "
            "3 but only 3 elements");
}

TEST(GltfAccessor, ReadsColoursOfThreeAndFourComponents) {
  GltfSample sample;
  sample.add_triangle(",\"COLOR_0\":1");
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "VEC3", 3, {255, 0, 0, 0, 255, 0, 0, 0, 51},
                                    ",\"normalized\":true");
  EXPECT_EQ(load_sample(sample).scene.meshes.at(0).colors,
            (std::vector<Vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.2f, 1}}));

  sample.accessors.pop_back();
  sample.add_accessor<float>(gl_float, "VEC4", 3, {0.5f, 0, 0, 0.5f, 0, 1.5f, 0, 1, 0, 0, -1, 0});
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.meshes.at(0).colors, (std::vector<Vec4>{{0.5f, 0, 0, 0.5f}, {0, 1, 0, 1}, {0, 0, 0, 0}}));
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"meshes[0].primitives[0].attributes.COLOR_0: has values outside "
                                                      "of [0, 1], they are clamped"});
}

template <class Index>
void expect_indices(int component_type) {
  GltfSample sample;
  sample.add_triangle("", ",\"indices\":1");
  sample.add_accessor<Index>(component_type, "SCALAR", 6, {0, 1, 2, 2, 1, 0});
  EXPECT_EQ(load_sample(sample).scene.meshes.at(0).triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}}));
}

TEST(GltfAccessor, ReadsIndicesOfAllTypes) {
  expect_indices<std::uint8_t>(gl_unsigned_byte);
  expect_indices<std::uint16_t>(gl_unsigned_short);
  expect_indices<std::uint32_t>(gl_unsigned_int);
}

TEST(GltfAccessor, RefusesBadIndices) {
  const auto error_of = [](int component_type, const std::string& type, std::vector<std::uint32_t> values) {
    GltfSample sample;
    sample.add_triangle("", ",\"indices\":1");
    sample.add_accessor<std::uint32_t>(component_type, type, 3, values);
    return load_error(sample);
  };
  const std::string place = "model.gltf: meshes[0].primitives[0].indices: accessor 1 ";
  EXPECT_EQ(error_of(gl_unsigned_int, "SCALAR", {0, 1, 3}),
            place + "element 2 is 3, beyond the last vertex; the mesh has 3 vertices");
  EXPECT_EQ(error_of(gl_unsigned_int, "SCALAR", {0, 0xffffffffu, 2}),
            place + "element 1 is 4294967295, the primitive restart value; the mesh has 3 vertices");
  EXPECT_EQ(error_of(gl_float, "SCALAR", {0, 1, 2}), place + "must have unsigned integers for indices");
  EXPECT_EQ(error_of(gl_short, "SCALAR", {0, 1, 2}), place + "must have unsigned integers for indices");
  EXPECT_EQ(error_of(gl_unsigned_byte, "VEC2", {0, 1, 2}), place + "must be of type SCALAR");
}

TEST(GltfAccessor, RefusesReadsBeyondTheBufferView) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 13, {0, 0, 0, 1, 0, 0, 0, 1, 0});  // 36 of 156 bytes
  sample.add_triangle();
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].attributes.POSITION: accessor 0 reads 120 bytes beyond buffer view 0");

  // The end of the read would overflow 64 bits if sizes were not limited; 2^48 is the largest that is let through.
  sample.accessors[0] =
      R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":281474976710656,"byteOffset":281474976710656})";
  EXPECT_NE(load_error(sample), "");
  sample.accessors[0] = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":18446744073709551615})";
  EXPECT_EQ(load_error(sample), "model.gltf: accessors[0].count: is too large");
}

TEST(GltfAccessor, ChecksAccessorsThatNothingUses) {
  GltfSample sample;
  sample.add_triangle();
  sample.add_accessor<float>(gl_float, "MAT4", 2, std::vector<float>(16));
  EXPECT_EQ(load_error(sample), "model.gltf: accessors[1]: accessor 1 reads 64 bytes beyond buffer view 1");
}

TEST(GltfAccessor, RefusesEndlessZeros) {
  GltfSample sample;
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC3","count":4000000000})");
  sample.add_triangle();
  EXPECT_NE(load_error(sample), "");
}

// A primitive that uses three of many vertices holds three; the accessor is shared by the next one.
TEST(GltfAccessor, LeavesOutVerticesThatAPrimitiveDoesNotUse) {
  GltfSample sample;
  std::vector<float> positions;
  for (int v = 0; v < 100; ++v) positions.insert(positions.end(), {float(v), float(v * v), 0});
  sample.add_accessor<float>(gl_float, "VEC3", 100, positions);
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 3, {97, 5, 50});
  std::vector<std::uint8_t> most;
  for (std::uint8_t v = 1; v < 100; ++v) most.push_back(v);
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 99, most);
  sample.meshes.push_back(
      R"({"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"indices":2}]})");
  sample.nodes.push_back(R"({"mesh":0})");
  const LoadedScene loaded = load_sample(sample);
  ASSERT_EQ(loaded.scene.meshes.size(), 2u);
  EXPECT_EQ(loaded.scene.meshes[0].positions, (std::vector<Vec3>{{5, 25, 0}, {50, 2500, 0}, {97, 9409, 0}}));
  EXPECT_EQ(loaded.scene.meshes[0].triangles, (std::vector<Triangle>{{2, 0, 1}}));
  EXPECT_EQ(loaded.scene.meshes[1].positions.size(), 99u);
  EXPECT_EQ(loaded.scene.meshes[1].positions[0], Vec3(1, 1, 0));
  EXPECT_EQ(loaded.scene.meshes[1].triangles[0], Triangle(0, 1, 2));
}

}  // namespace
}  // namespace candil::test

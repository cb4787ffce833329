#include <gtest/gtest.h>

#include "io/error.h"
#include "io/resource.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {
namespace {

const std::string asset = R"("asset":{"version":"2.0"})";

TEST(GltfError, NamesThePlaceOfWrongTypesAndReferences) {
  const std::string start = "{" + asset + ",";
  EXPECT_EQ(load_error(start + R"("meshes":{}})"), "model.gltf: meshes: must be an array");
  EXPECT_EQ(load_error(start + R"("nodes":[7]})"), "model.gltf: nodes[0]: must be an object");
  EXPECT_EQ(load_error(start + R"("nodes":[{"translation":[1,2]}]})"),
            "model.gltf: nodes[0].translation: must have 3 elements, has 2");
  EXPECT_EQ(load_error(start + R"("nodes":[{"mesh":"0"}]})"), "model.gltf: nodes[0].mesh: must be an integer");
  EXPECT_EQ(load_error(start + R"("nodes":[{"mesh":-1}]})"), "model.gltf: nodes[0].mesh: must not be negative");
  EXPECT_EQ(load_error(start + R"("nodes":[{"mesh":1.5}]})"), "model.gltf: nodes[0].mesh: must be an integer");
  EXPECT_EQ(load_error(start + R"("nodes":[{"mesh":4}]})"),
            "model.gltf: nodes[0].mesh: index 4 does not exist: there are 0 in meshes");
  EXPECT_EQ(load_error(start + R"("materials":[{"normalTexture":{"index":0}}]})"),
            "model.gltf: materials[0].normalTexture.index: index 0 does not exist: there are 0 in textures");
  EXPECT_EQ(load_error(start + R"("accessors":[{"componentType":5126,"count":1}]})"),
            "model.gltf: accessors[0].type: is missing");
  EXPECT_EQ(load_error(start + R"("accessors":[{"componentType":5126,"count":1,"type":"VEC5"}]})"),
            "model.gltf: accessors[0].type: \"VEC5\" is none of: SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4");
  EXPECT_EQ(load_error(start + R"("accessors":[{"componentType":5124,"count":1,"type":"VEC2"}]})"),
            "model.gltf: accessors[0].componentType: 5124 is none of: 5120 5121 5122 5123 5125 5126");
  EXPECT_EQ(load_error(start + R"("materials":[{"extensions":{"KHR_materials_ior":3}}]})"),
            "model.gltf: materials[0].extensions: the member \"KHR_materials_ior\" must be an object");
  EXPECT_EQ(load_error(start + R"("nodes":[{"mesh":0.0}],"meshes":[{"primitives":[]}]})"), "") << "0.0 is an integer";
}

TEST(GltfError, RefusesStridesThatNoAttributeHas) {
  const auto error_of = [](const std::string& stride) {
    return load_error("{" + asset + R"(,"buffers":[{"byteLength":3,"uri":"data:;base64,AAEC"}],"bufferViews":[)" +
                      R"({"buffer":0,"byteLength":3,"byteStride":)" + stride + "}]}");
  };
  EXPECT_EQ(error_of("252"), "");
  for (const char* stride : {"5", "256"}) {
    EXPECT_EQ(error_of(stride),
              std::string("model.gltf: bufferViews[0].byteStride: must be 4, 8, ... or 252, not ") + stride);
  }
}

TEST(GltfError, RefusesOtherVersions) {
  EXPECT_EQ(load_error(R"({"asset":{"version":"1.0"}})"),
            "model.gltf: asset.version: 1.0 is not supported, only 2.x is");
  EXPECT_EQ(load_error(R"({"asset":{"version":2.0}})"), "model.gltf: asset.version: must be a string");
  EXPECT_EQ(load_error(R"({"asset":{}})"), "model.gltf: asset.version: is missing");
  EXPECT_EQ(load_error("{}"), "model.gltf: asset: is missing: this is not a glTF 2.0 file");
  EXPECT_EQ(load_error(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
            "model.gltf: asset.minVersion: 2.1 is not supported, 2.0 is");
  EXPECT_EQ(load_error(R"({"asset":{"version":"2.1"}})"), "");
}

TEST(GltfError, NamesAllRequiredExtensionsThatAreMissing) {
  EXPECT_EQ(load_error("{" + asset + R"(,"extensionsRequired":["KHR_mesh_quantization","B_b","KHR_xmp","A_a"]})"),
            "model.gltf: extensionsRequired: A_a, B_b are not supported; export the file without them");
  const LoadedScene loaded =
      load_text("{" + asset + R"(,"extensionsUsed":["KHR_materials_ior","KHR_xmp","ACME_paint"]})");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"extension ACME_paint is not supported and ignored"});
  EXPECT_EQ(loaded.contents.extensions_used, (std::vector<std::string>{"ACME_paint", "KHR_materials_ior", "KHR_xmp"}));
  EXPECT_EQ(loaded.extensions_unsupported, std::vector<std::string>{"ACME_paint"});
  EXPECT_EQ(load_text("{" + asset + R"(,"extensionsUsed":["KHR_materials_volume_scatter"]})").warnings,
            std::vector<std::string>{
                "extension KHR_materials_volume_scatter is ignored: --experimental volume-scatter has it"});
  ASSERT_EQ(loaded.not_honoured.size(), 2u);
  EXPECT_EQ(loaded.not_honoured[0].what + ", " + loaded.not_honoured[0].reason, "ACME_paint, unsupported");
  EXPECT_EQ(loaded.not_honoured[1].what + ", " + loaded.not_honoured[1].reason, "KHR_xmp, ignored: metadata");
}

TEST(GltfError, RefusesWhatIsNotGltf) {
  EXPECT_EQ(load_error(""), "model.gltf: the file is empty");
  EXPECT_EQ(load_error("solid cube\n"),
            "model.gltf: is no scene file: it holds neither glTF (.gltf, .glb) nor PLY nor a scene in JSON");
  EXPECT_EQ(load_error("{\"asset\":").substr(0, 40), "model.gltf: JSON: parse error at line 1,");
  EXPECT_EQ(load_error("{\"a\":" + std::string(100000, '[')), "model.gltf: JSON: is nested deeper than 128 levels");
  EXPECT_EQ(load_error("{" + asset + ",\"extras\":\"" + std::string(500, '[') + "\\\"[\"}"), "")
      << "brackets in strings do not nest";
}

TEST(GltfError, ReadsAndRefusesBinaryContainers) {
  const std::string json = "{" + asset + R"(,"buffers":[{"byteLength":6}]})";
  EXPECT_EQ(load_error(make_glb(json, "123456")), "");
  EXPECT_EQ(load_error(make_glb(json, "1234")), "model.gltf: buffers[0].byteLength: declares 6 bytes, there are 4");
  EXPECT_EQ(load_error(make_glb(json, "")), "model.gltf: buffers[0]: has no uri and the file no binary chunk for it");
  const std::string whole = make_glb(json, "123456");
  EXPECT_EQ(load_error(whole.substr(0, whole.size() - 1)).substr(0, 35), "model.gltf: GLB: the header declare");
  EXPECT_EQ(load_error(make_glb(json, "123456", -4)), "model.gltf: GLB: chunk 1 is longer than the file");
  for (std::size_t length = 4; length < whole.size(); ++length) {
    EXPECT_NE(load_error(whole.substr(0, length)), "") << length;
  }
}

TEST(GltfError, DataUris) {
  const auto error_of = [](const std::string& uri) {
    return load_error("{" + asset + ",\"buffers\":[{\"byteLength\":3,\"uri\":\"" + uri + "\"}]}");
  };
  EXPECT_EQ(error_of("data:application/octet-stream;base64,AAEC"), "");
  EXPECT_EQ(error_of("data:,a%20b"), "");
  EXPECT_EQ(error_of("data:application/octet-stream;base64,A*EC"),
            "model.gltf: buffers[0].uri: the data URI is not valid base64");
  EXPECT_EQ(error_of("data:application/octet-stream;base64"), "model.gltf: buffers[0].uri: the data URI has no comma");
  EXPECT_EQ(error_of("data:;base64,AAE="), "model.gltf: buffers[0].byteLength: declares 3 bytes, there are 2");
}

/// A scene folder beside a secret that no reference may reach.
class References : public testing::Test {
 protected:
  References() {
    std::filesystem::create_directories(folder_ / "scene/sub");
    write_text(folder_ / "secret.bin", "secret");
    write_text(folder_ / "scene/a b.bin", "inside");
    write_text(folder_ / "scene/sub/c.bin", "inside");
  }
  std::string error_of(const std::string& uri) const {
    const std::string text = "{" + asset + ",\"buffers\":[{\"byteLength\":6,\"uri\":\"" + uri + "\"}]}";
    write_text(folder_ / "scene/model.gltf", text);
    try {
      load_scene(folder_ / "scene/model.gltf");
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.substr(message.find("model.gltf"));
    }
    return {};
  }
  const TemporaryFolder folder_;
};

TEST_F(References, InsideTheFolderAreRead) {
  EXPECT_EQ(error_of("a b.bin"), "");
  EXPECT_EQ(error_of("a%20b.bin"), "");
  EXPECT_EQ(error_of("sub/c.bin"), "");
  EXPECT_EQ(error_of("./sub/../sub/c.bin"), "");
  write_text(folder_ / "scene/x%41.bin", "inside");
  EXPECT_EQ(error_of("x%41.bin"), "") << "a file that really has this name";
}

TEST_F(References, ThatLeadOutAreRefused) {
  const std::string place = "model.gltf: buffers[0].uri: ";
  EXPECT_EQ(error_of("../secret.bin"), place + "\"../secret.bin\" leaves the folder of the scene file");
  EXPECT_EQ(error_of("sub/../../secret.bin"), place + "\"sub/../../secret.bin\" leaves the folder of the scene file");
  EXPECT_EQ(error_of("%2e%2e/secret.bin"), place + "\"%2e%2e/secret.bin\" leaves the folder of the scene file");
  EXPECT_EQ(error_of("..%2Fsecret.bin"), place + "\"..%2Fsecret.bin\" leaves the folder of the scene file");
  EXPECT_EQ(error_of("..\\\\secret.bin"), place + "\"..\\secret.bin\" leaves the folder of the scene file");
  for (const char* uri : {"/etc/hostname", "%2Fetc/hostname", "//host/share", "\\\\\\\\host\\\\share"}) {
    EXPECT_NE(error_of(uri).find("is an absolute path; only files beside the scene are read"), std::string::npos)
        << uri;
  }
  for (const char* uri : {"http://example.com/a.bin", "file:///etc/hostname", "C:/secret.bin", "c%3A/secret.bin"}) {
    EXPECT_NE(error_of(uri).find("has a scheme or drive letter"), std::string::npos) << uri;
  }
  EXPECT_EQ(error_of("nothing.bin"), place + "\"nothing.bin\" does not exist");
  EXPECT_EQ(error_of("sub"), place + "\"sub\" is not a regular file");
  EXPECT_EQ(error_of("a%00b"), place + "\"a%00b\" contains a zero byte");
  EXPECT_EQ(error_of(""), place + "\"\" is empty");
}

TEST_F(References, ThroughSymbolicLinksMustStayInside) {
  std::filesystem::create_symlink(folder_ / "secret.bin", folder_ / "scene/link.bin");
  std::filesystem::create_directory_symlink(folder_.path(), folder_ / "scene/up");
  std::filesystem::create_symlink("sub/c.bin", folder_ / "scene/good.bin");
  EXPECT_EQ(error_of("link.bin"), "model.gltf: buffers[0].uri: \"link.bin\" leads out of the folder of the scene file");
  EXPECT_NE(error_of("up/secret.bin"), "");
  EXPECT_EQ(error_of("good.bin"), "");
}

TEST_F(References, MissingImagesAreNamed) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"emissiveTexture":{"index":0}})"};
  sample.textures = {R"({"source":1})"};
  sample.images = {R"({"uri":"unused.png"})", R"({"uri":"missing.png"})"};
  EXPECT_EQ(load_error(sample), "model.gltf: images[1].uri: \"missing.png\" does not exist");
}

TEST(GltfError, SceneFileItself) {
  const TemporaryFolder folder;
  for (const std::filesystem::path& path : {folder / "none.gltf", folder.path()}) {
    EXPECT_THROW(load_scene(path), InputError) << path;
  }
}

}  // namespace
}  // namespace candil::test

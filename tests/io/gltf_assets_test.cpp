/// Every sample model and every hostile file of the optional assets folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "io/error.h"
#include "io/load_scene.h"

namespace candil {
namespace {

std::vector<std::filesystem::path> gltf_files(const std::string& subfolder) {
  const char* variable = std::getenv("CANDIL_ASSETS");
  const std::filesystem::path root = variable != nullptr ? variable : CANDIL_ASSETS_DIR;
  std::vector<std::filesystem::path> files;
  std::error_code error;
  if (root.empty()) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / subfolder, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What renderers rely on without looking again.
void expect_valid(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const std::size_t count = mesh.positions.size();
    EXPECT_LT(mesh.material, scene.materials.size());
    for (const Triangle t : mesh.triangles) ASSERT_TRUE(t.x < count && t.y < count && t.z < count);
    for (const Vec3 p : mesh.positions) ASSERT_TRUE(is_finite(p));
    for (const Vec3 n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-3f);
    for (const Vec4 t : mesh.tangents) ASSERT_TRUE(std::abs(glm::length(Vec3(t)) - 1) < 1e-3f && std::abs(t.w) == 1);
    for (const std::size_t size :
         {mesh.normals.size(), mesh.tangents.size(), mesh.uvs[0].size(), mesh.uvs[1].size(), mesh.colors.size()}) {
      EXPECT_TRUE(size == 0 || size == count);
    }
  }
  for (const Object& object : scene.objects) EXPECT_LE(object.first_mesh + object.mesh_count, scene.meshes.size());
  for (const Instance& instance : scene.instances) EXPECT_LT(instance.object, scene.objects.size());
  for (const Texture& texture : scene.textures) EXPECT_LT(texture.image, scene.images.size());
  for (const Material& material : scene.materials) {
    for (const TextureSlot& slot : {material.base_color_texture, material.normal_texture, material.emission_texture}) {
      EXPECT_TRUE(!slot.is_used() || (slot.texture < scene.textures.size() && slot.uv_set < 2));
    }
  }
}

TEST(GltfAssets, SampleModelsLoadOrNameTheExtensionTheyNeed) {
  const auto files = gltf_files("gltf");
  if (files.empty()) GTEST_SKIP() << "no assets folder";
  int loaded_count = 0;
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.string());
    try {
      const LoadedScene loaded = load_scene(file);
      expect_valid(loaded.scene);
      ++loaded_count;
    } catch (const InputError& error) {
      const std::string message = error.what();
      const bool is_expected = message.find("extensionsRequired: ") != std::string::npos ||
                               message.find("asset.minVersion: ") != std::string::npos ||
                               message.find("libzstd-dev") != std::string::npos;  // for a build without it
      EXPECT_TRUE(is_expected) << message;
    }
  }
  EXPECT_GT(loaded_count, static_cast<int>(files.size()) * 4 / 5);
}

TEST(GltfAssets, HostileFilesLoadOrGiveAnError) {
  const auto files = gltf_files("bad");
  if (files.empty()) GTEST_SKIP() << "no assets folder";
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file.string());
    try {
      expect_valid(load_scene(file).scene);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(message.rfind(file.string(), 0), 0u) << message;
    }
  }
}

}  // namespace
}  // namespace candil

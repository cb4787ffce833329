/// Every PLY file of the optional assets folder: it loads, or says why not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "io/error.h"
#include "io/load_scene.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> ply_files() {
  const char* const variable = std::getenv("CANDIL_ASSETS");
  const fs::path root = variable != nullptr ? variable : CANDIL_ASSETS_DIR;
  std::vector<fs::path> files;
  std::error_code error;
  for (const char* const folder : {"meshes", "bad"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder, error))
      if (entry.path().extension() == ".ply") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(PlyAssets, LoadOrSayWhyNot) {
  // Triangles as the list of the models has them, which was made by other programs.
  const std::map<std::string, std::size_t> triangles = {{"bun_zipper.ply", 69451},
                                                        {"bunny_be.ply", 69451},
                                                        {"bunny_be_confidence_normals.ply", 69451},
                                                        {"bunny_le_normals.ply", 69451},
                                                        {"dragon_47794.ply", 47794},
                                                        {"dragon_100k_le_rgba.ply", 100000},
                                                        {"dragon_100k_ascii_normals.ply", 100000},
                                                        {"spot_ascii_st.ply", 5856},
                                                        {"spot_be_double_normals_uv.ply", 5856},
                                                        {"spot_quads_le.ply", 5856},
                                                        {"suzanne_mixed_ascii.ply", 968},
                                                        {"suzanne_mixed_be_faceflags.ply", 968},
                                                        {"teapot_ascii.ply", 6320},
                                                        {"teapot_le_normals.ply", 6320},
                                                        {"cube_binary_starts_with_nl.ply", 12},
                                                        {"cube_binary_header_with_RN_newline.ply", 12},
                                                        {"Box.ply", 12},
                                                        {"Wuson.ply", 3732},
                                                        {"fuze.ply", 1000},
                                                        {"fuze_ascii.ply", 1000}};
  const std::vector<fs::path> files = ply_files();
  if (files.empty()) GTEST_SKIP() << "no sample models; set CANDIL_ASSETS_DIR";
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    std::size_t count = 0;
    try {
      const Scene scene = load_scene(file).scene;
      count = instanced_triangle_count(scene);
      for (const Mesh& mesh : scene.meshes) {
        for (const Triangle t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
        for (const Vec3 p : mesh.positions) ASSERT_TRUE(is_finite(p));
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        for (const Vec3 n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-3f);
      }
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    const auto known = triangles.find(file.filename().string());
    if (known != triangles.end()) {
      EXPECT_EQ(count, known->second);
    }
  }
}

}  // namespace
}  // namespace candil

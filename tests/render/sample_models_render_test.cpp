// Every sample model, small: it loads, or says which extension is missing; no sample of it is NaN, and there is
// something to be seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/studio.h"
#include "integrators/render.h"
#include "io/error.h"
#include "io/load_scene.h"
#include "materials/alpha.h"

namespace candil::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sample_models() {
  std::vector<fs::path> models;
  const fs::path folder = fs::path(CANDIL_ASSETS_DIR) / "gltf";
  if (!fs::is_directory(folder)) return models;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") models.push_back(entry.path());
  }
  std::sort(models.begin(), models.end());
  return models;
}

/// A scene and all that a render of it needs.
class Studio {
 public:
  explicit Studio(Scene scene) : scene_(lit(std::move(scene))), lights_(scene_), tables_(scene_) {}

  /// The whole scene from `azimuth` (radians about +Y) and somewhat above.
  RenderResult photograph(float azimuth, bool is_background_transparent) const {
    RenderSettings settings;
    settings.width = 32, settings.height = 24;
    settings.samples_per_pixel = 2;
    settings.transparent_background = is_background_transparent;
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    return render({scene_, *accelerator_, lights_, tables_}, frame_points(scene_outline(scene_), azimuth, 0.4f, aspect),
                  settings);
  }

 private:
  static Scene lit(Scene scene) {
    if (!has_light(scene)) scene.environment = make_studio_environment();
    return scene;
  }

  const Scene scene_;
  const std::unique_ptr<Accelerator> accelerator_ = make_accelerator(scene_, alpha_filter());
  const LightSampler lights_;
  const BsdfTables tables_;
};

/// A cutoff above 1 leaves nothing of a material (glTF 2.0, section 3.9.4).
bool has_invisible_material(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return material.alpha_mode == AlphaMode::mask && material.alpha_cutoff > 1;
  });
}

void expect_sound_picture(const Scene& scene) {
  const Studio studio(scene);
  bool is_seen = false;
  // From one side and from the opposite one: a single face has a front only.
  for (const float azimuth : {0.6f, 0.6f + pi}) {
    const RenderResult result = studio.photograph(azimuth, false);
    EXPECT_EQ(result.non_finite_samples, 0u);
    const Image mean = result.film.mean();
    for (const float value : mean.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
    const Image coverage = studio.photograph(azimuth, true).film.mean();
    for (std::size_t i = 3; i < coverage.pixels.size(); i += 4) is_seen = is_seen || coverage.pixels[i] > 0;
  }
  EXPECT_TRUE(is_seen || scene_bounds(scene).is_empty() || has_invisible_material(scene));
}

TEST(SampleModels, RenderWithoutAnyNonFiniteSample) {
  const std::vector<fs::path> models = sample_models();
  if (models.empty()) GTEST_SKIP() << "no sample models; set CANDIL_ASSETS_DIR";
  int rendered = 0;
  for (const fs::path& model : models) {
    SCOPED_TRACE(model.filename().string());
    try {
      expect_sound_picture(load_scene(model).scene);
      ++rendered;
    } catch (const InputError& error) {
      // Names the extension, or the version that only a newer specification has.
      const std::regex reason("(extensionsRequired: [A-Z]+_\\w+.* not supported|asset\\.minVersion: )");
      EXPECT_TRUE(std::regex_search(error.what(), reason)) << error.what();
    }
  }
  EXPECT_GT(rendered, 0);
}

}  // namespace
}  // namespace candil::test

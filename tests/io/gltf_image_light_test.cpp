// EXT_lights_image_based: where the faces of the cube are seen, and what their pixels mean.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/color.h"
#include "core/environment.h"
#include "io/cube_map.h"
#include "io/image_file.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

constexpr std::array<Vec3, 6> axes = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                      Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

/// A grey for each face: stored levels 40, 80 ... 240.
int level_of(std::size_t face) { return 40 * (static_cast<int>(face) + 1); }

std::vector<std::byte> grey_png(int level, int size = 4) {
  Image image(size, size, 3);
  for (float& value : image.pixels) value = static_cast<float>(level) / 255;
  return encode_png(image, false);
}

/// A file with one light, whose six images are `faces`. `light`: further members, `before` a comma.
std::string light_file(const std::vector<std::vector<std::byte>>& faces, const std::string& light = "", int size = 4) {
  std::string images, row;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    images += (i ? "," : "") + ("{\"uri\":\"data:image/png;base64," + to_base64(faces[i]) + "\"}");
    row += (i ? "," : "") + std::to_string(i);
  }
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_lights_image_based"],
      "extensionsRequired":["EXT_lights_image_based"],"images":[)" +
         images + R"(],"extensions":{"EXT_lights_image_based":{"lights":[{"irradianceCoefficients":[],
      "specularImageSize":)" +
         std::to_string(size) + R"(,"specularImages":[[)" + row + "]]" + light +
         R"(}]}},"scene":0,"scenes":[{"extensions":{"EXT_lights_image_based":{"light":0}}},{}]})";
}

std::vector<std::vector<std::byte>> six_greys() {
  std::vector<std::vector<std::byte>> faces;
  for (std::size_t face = 0; face < 6; ++face) faces.push_back(grey_png(level_of(face)));
  return faces;
}

Vec3 seen(const LoadedScene& loaded, Vec3 direction) {
  return EnvironmentLight(loaded.scene.environment).radiance(glm::normalize(direction));
}

void expect_grey(const LoadedScene& loaded, Vec3 direction, int level, float factor = 1) {
  EXPECT_NEAR(seen(loaded, direction).y, factor * srgb_to_linear(static_cast<float>(level) / 255), 1e-4f)
      << direction.x << " " << direction.y << " " << direction.z;
}

TEST(GltfImageLight, EveryFaceIsSeenWhereItIsCalled) {
  const LoadedScene loaded = load_text(light_file(six_greys()));
  EXPECT_TRUE(loaded.warnings.empty());
  for (std::size_t face = 0; face < 6; ++face) expect_grey(loaded, axes[face], level_of(face));
}

// A quarter about +Z (0, 0, sin 45, cos 45) carries +X to +Y and +Y to -X; a third about (1, 1, 1) (1/2, 1/2, 1/2, 1/2)
// carries X to Y to Z to X. Neither can be had by turning about +Y.
TEST(GltfImageLight, IsTurnedAboutAnyAxis) {
  const LoadedScene quarter =
      load_text(light_file(six_greys(), R"(,"rotation":[0,0,0.70710678,0.70710678],"intensity":3)"));
  for (const auto& [face, towards] : {std::pair(0, 2), {2, 1}, {1, 3}, {3, 0}, {4, 4}, {5, 5}})
    expect_grey(quarter, axes[static_cast<std::size_t>(towards)], level_of(static_cast<std::size_t>(face)), 3);
  const LoadedScene third = load_text(light_file(six_greys(), R"(,"rotation":[1,1,1,1])"));
  EXPECT_TRUE(third.warnings.empty()) << "normalised";
  for (const auto& [face, towards] : {std::pair(0, 2), {2, 4}, {4, 0}, {1, 3}, {3, 5}, {5, 1}})
    expect_grey(third, axes[static_cast<std::size_t>(towards)], level_of(static_cast<std::size_t>(face)));
}

// Inside of a cube that is seen as it is saved, the edges of the images meet: every image here is red to its left,
// green at its top. Looking at +Z with +Y up, left is +X; looking at +X, it is -Z, and so on; looking up (the top is
// -Z), it is +X... which the cross product of the top and the direction tells.
TEST(GltfImageLight, ImagesAreUprightAndNotMirrored) {
  Image image(16, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) image.pixel(x, y)[0] = x < 8 ? 1.0f : 0.0f, image.pixel(x, y)[1] = y < 8 ? 1.0f : 0.0f;
  const LoadedScene loaded =
      load_text(light_file(std::vector<std::vector<std::byte>>(6, encode_png(image, false)), "", 16));
  for (const Vec3 towards : axes) {
    const Vec3 top = towards.y == 0 ? Vec3(0, 1, 0) : Vec3(0, 0, -towards.y), left = glm::cross(top, towards);
    for (const float up : {-0.5f, 0.5f}) {
      for (const float aside : {-0.5f, 0.5f}) {
        const Vec3 color = seen(loaded, towards + up * top + aside * left);
        EXPECT_NEAR(color.x, aside > 0 ? 1 : 0, 1e-4f) << towards.x << towards.y << towards.z << up << aside;
        EXPECT_NEAR(color.y, up > 0 ? 1 : 0, 1e-4f) << towards.x << towards.y << towards.z << up << aside;
      }
    }
  }
}

// RGBD: (1, 1/2, 0) linear divided by 1/4 is (4, 2, 0).
TEST(GltfImageLight, AlphaIsADivisor) {
  Image image(4, 4, 4);
  for (std::size_t i = 0; i < 16; ++i) {
    image.pixels[4 * i] = 1, image.pixels[4 * i + 1] = 188 / 255.0f, image.pixels[4 * i + 3] = 51 / 255.0f;
  }
  const LoadedScene loaded = load_text(light_file(std::vector<std::vector<std::byte>>(6, encode_png(image, true))));
  EXPECT_NEAR(seen(loaded, Vec3(1, 2, 3)).x, 5, 1e-4f);
  EXPECT_NEAR(seen(loaded, Vec3(1, 2, 3)).y, 5 * srgb_to_linear(188 / 255.0f), 1e-4f);
  EXPECT_EQ(seen(loaded, Vec3(1, 2, 3)).z, 0);
}

// The mean over the sphere of a cube with one face of radiance 1 is a sixth.
TEST(GltfImageLight, ResamplingKeepsEnergy) {
  CubeFaces faces;
  for (Image& face : faces) face = Image(32, 32, 3);
  for (float& value : faces[2].pixels) value = 1;
  Environment environment;
  environment.tint = Vec3(1);
  // A turn of 0.7 rad about +X: no face lies along the rows of the result.
  environment.image = to_latitude_longitude(
      faces, Mat3(1, 0, 0, 0, std::cos(0.7f), std::sin(0.7f), 0, -std::sin(0.7f), std::cos(0.7f)));
  EXPECT_EQ(environment.image.width, 128);
  const Image& image = environment.image;
  double sum = 0, weight = 0;
  for (int y = 0; y < image.height; ++y) {
    const double area = std::sin(pi * (y + 0.5) / image.height);
    for (int x = 0; x < image.width; ++x) sum += area * image.pixel(x, y)[1], weight += area;
  }
  EXPECT_NEAR(sum / weight, 1.0 / 6, 1e-3);
}

TEST(GltfImageLight, BelongsToItsScene) {
  LoadOptions second;
  second.scene = "1";
  EXPECT_FALSE(load_text(light_file(six_greys()), second).scene.environment.is_present());
}

TEST(GltfImageLight, WarnsOfOddNumbers) {
  const LoadedScene loaded = load_text(light_file(six_greys(), R"(,"rotation":[0,0,0,0],"intensity":-1)", 8));
  EXPECT_EQ(loaded.warnings.size(), 3u);
  EXPECT_FALSE(loaded.scene.environment.is_present());
}

TEST(GltfImageLight, RefusesWhatMakesNoCube) {
  const std::string lights = "model.gltf: extensions.EXT_lights_image_based.lights";
  auto faces = six_greys();
  faces[3] = grey_png(1, 8);
  EXPECT_EQ(load_error(light_file(faces)), lights + "[0].specularImages[0]: the six images must have one size");
  faces.pop_back();
  EXPECT_EQ(load_error(light_file(faces)), lights + "[0].specularImages[0]: must have 6 elements, has 5");
  Image oblong(4, 2, 3);
  faces = six_greys();
  faces[0] = encode_png(oblong, false);
  EXPECT_EQ(load_error(light_file(faces)), "model.gltf: images[0]: a face of a cube map must be square");
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = light_file(six_greys());
  EXPECT_EQ(load_error(replaced(good, "[[0,1,2,3,4,5]]", "[]")), lights + "[0].specularImages: must not be empty");
  EXPECT_EQ(load_error(replaced(good, "[[0,1,2,3,4,5]]", "[[0,1,2,3,4,6]]")),
            lights + "[0].specularImages[0][5]: index 6 does not exist: there are 6 in images");
  EXPECT_EQ(load_error(replaced(good, "[[0,1,2,3,4,5]]", "[7]")), lights + "[0].specularImages[0]: must be an array");
  EXPECT_EQ(load_error(replaced(good, R"("light":0)", R"("light":1)")),
            "model.gltf: scenes[0].extensions.EXT_lights_image_based.light: index 1 does not exist: there is 1 in "
            "image-based lights");
  EXPECT_EQ(load_error(replaced(good, "\"irradianceCoefficients\":[],", "")),
            lights + "[0].irradianceCoefficients: is missing");
}

}  // namespace
}  // namespace candil::test

// One picture, whichever accelerator finds the hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/camera.h"
#include "core/shape.h"
#include "integrators/render.h"
#include "tests/support/accelerator_cases.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A texture of coloured squares, some of them holes.
std::uint32_t add_texture(Scene& scene) {
  TextureImage image;
  image.width = image.height = 8;
  for (int i = 0; i < 64; ++i) {
    const int square = i % 8 + i / 8;
    image.rgba8.emplace_back(60 + 25 * (i % 8), 40 + 25 * (i / 8), 150, square % 3 == 0 ? 0 : 255);
  }
  scene.images.push_back(image);
  scene.textures.push_back(
      {static_cast<std::uint32_t>(scene.images.size() - 1), Wrap::repeat, Wrap::repeat, Filter::nearest});
  return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

/// Something of everything: textured floor, masked screens, single-sided and smooth meshes, instances that are moved,
/// stretched and mirrored, spheres, a disc, a plane, and (if wanted) a surface with an alpha of one half.
Scene everything(bool has_blend) {
  SceneBuilder builder;
  Scene& scene = builder.scene;
  Material textured;
  textured.base_color_texture.texture = add_texture(scene);
  textured.metallic = 0, textured.is_double_sided = true;
  Material screen = textured;
  screen.alpha_mode = AlphaMode::mask;
  const std::uint32_t floor = builder.add_material(textured), cut = builder.add_material(screen);
  const std::uint32_t grey = builder.add_diffuse(Vec3(0.6f)), one_sided = builder.add_material(Material{});
  builder.add_quad(Vec3(-3, 0, 3), Vec3(6, 0, 0), Vec3(0, 0, -6), floor);
  builder.add_quad(Vec3(-2, 0, -1), Vec3(1.6f, 0, 0.3f), Vec3(0, 1.7f, 0), cut);
  builder.add_quad(Vec3(0.5f, 0, -2), Vec3(1.6f, 0, -0.3f), Vec3(0, 1.7f, 0.2f), one_sided);
  builder.add_quad(Vec3(-1, 3.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_diffuse(Vec3(0), Vec3(8)));
  const std::uint32_t ball = builder.add_sphere(Vec3(0), 0.4f, grey, 10);
  scene.instances.pop_back();
  const std::uint32_t object = static_cast<std::uint32_t>(scene.objects.size() - 1);
  const float c = std::cos(0.6f), s = std::sin(0.6f);
  const Mat3 turned(Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c));
  for (const Affine& to_world :
       {Affine{Mat3(1), Vec3(-0.9f, 0.5f, 0.6f)},
        Affine{turned * Mat3(Vec3(1.5f, 0, 0), Vec3(0.2f, 0.6f, 0), Vec3(0, 0, 1)), Vec3(0.9f, 0.4f, 0.3f)},
        Affine{Mat3(Vec3(-1, 0, 0), Vec3(0, 1.6f, 0), Vec3(0.3f, 0, 0.8f)), Vec3(0, 0.9f, -0.7f)}}) {
    scene.instances.push_back({"", object, to_world, false});
  }
  EXPECT_EQ(scene.objects[object].first_mesh, ball);
  builder.add_shape(ShapeKind::sphere,
                    {Mat3(Vec3(0.3f, 0, 0), Vec3(0, 0.2f, 0.1f), Vec3(0, 0, 0.3f)), Vec3(0.2f, 0.3f, 1.3f)}, one_sided);
  builder.add_shape(ShapeKind::sphere, {Mat3(0.25f), Vec3(-0.5f, 0.25f, 1.6f)}, grey);
  builder.add_shape(ShapeKind::disc, {turned * 0.4f, Vec3(1.6f, 0.8f, 1)}, cut);
  builder.add_shape(ShapeKind::plane, {Mat3(1), Vec3(0, 0, -3)}, grey);
  if (has_blend) {
    Material half = textured;
    half.alpha_mode = AlphaMode::blend, half.base_color_texture.texture = invalid_id, half.base_color.w = 0.5f;
    builder.add_quad(Vec3(-0.7f, 0, 2), Vec3(1.4f, 0, 0), Vec3(0, 0.6f, 0), builder.add_material(half));
  }
  scene.environment.tint = Vec3(0.2f, 0.25f, 0.3f);
  return scene;
}

const Camera camera = look_at(Vec3(0.6f, 1.6f, 4.5f), Vec3(0, 0.6f, 0), 0.7f);

Image picture(const Stage& stage, IntegratorKind integrator) {
  RenderSettings settings;
  settings.width = 80, settings.height = 60;
  settings.samples_per_pixel = 4;
  settings.integrator = integrator;
  settings.filter = FilterKind::box;
  return render(stage.context(), camera, settings).film.mean();
}

/// Share of the pixels that differ by more than 1 in 1000 of the brighter one.
double differing_share(const Image& a, const Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += static_cast<std::size_t>(a.channels)) {
    bool is_different = false;
    for (std::size_t c = i; c < i + 3; ++c) {
      is_different = is_different || std::abs(a.pixels[c] - b.pixels[c]) > 1e-3f * std::max(a.pixels[c], b.pixels[c]);
    }
    count += is_different;
  }
  return static_cast<double>(count * static_cast<std::size_t>(a.channels)) / static_cast<double>(a.pixels.size());
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const float value : image.pixels) sum += value;
  return sum / static_cast<double>(image.pixels.size());
}

class AcceleratorPicture : public testing::TestWithParam<AcceleratorChoice> {};

// What the camera sees is the same thing everywhere, but for ties: two surfaces within the step by which rays leave
// them, 2^-18 of the coordinates (offset_origin()), or a ray that passes an outline within rounding errors.
TEST_P(AcceleratorPicture, ShowsTheSameThings) {
  const Stage embree(everything(true)), stage(everything(true), GetParam());
  const CameraRays rays(camera, 320, 240);
  int ties = 0, hits = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      const Ray ray = rays.ray({static_cast<float>(x) + 0.37f, static_cast<float>(y) + 0.61f}, Vec2(0.5f));
      const Hit a = embree.accelerator().intersect(ray).value_or(Hit{});
      const Hit b = stage.accelerator().intersect(ray).value_or(Hit{});
      hits += !a.is_miss();
      if (a.is_miss() && b.is_miss()) continue;
      if (a.instance == b.instance && a.mesh == b.mesh && a.triangle == b.triangle) {
        // The places are as far off the surface; along a ray that grazes it, this is more.
        const float cosine = std::abs(glm::dot(ray.direction, make_surface_point(stage.scene(), a).normal_geometric));
        ASSERT_NEAR(a.t * cosine, b.t * cosine, 0x1p-18f * 5);
      } else {
        ++ties;
      }
    }
  }
  EXPECT_GT(hits, 60000);
  EXPECT_LE(ties, 8) << "of 76800 rays";  // a few edges of triangles within 1e-6 of pixels' rays
}

// Views of first hits differ in pixels with such ties only.
TEST_P(AcceleratorPicture, OfNormalsIsTheSame) {
  const Stage embree(everything(true)), stage(everything(true), GetParam());
  const Image expected = picture(embree, IntegratorKind::normals), found = picture(stage, IntegratorKind::normals);
  EXPECT_LE(differing_share(found, expected), 0.002);
}

// Paths start from hits that differ in their last bits, so that their decisions (which side of an edge, whether to
// go on) differ now and then. Without surfaces whose alpha is decided by a hash of the ray, these are few.
TEST_P(AcceleratorPicture, OfPathsIsTheSame) {
  const Stage embree(everything(false)), stage(everything(false), GetParam());
  const Image expected = picture(embree, IntegratorKind::path), found = picture(stage, IntegratorKind::path);
  EXPECT_LE(differing_share(found, expected), 0.02);
  EXPECT_NEAR(mean_of(found) / mean_of(expected), 1, 0.002);
}

INSTANTIATE_TEST_SUITE_P(All, AcceleratorPicture, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test

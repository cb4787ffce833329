// `path` has the expected value of `naive`, scene by scene: next-event estimation and its weights add nothing and lose
// nothing.
#include <gtest/gtest.h>

#include "tests/integrators/mean_comparison.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

struct NamedScene {
  const char* name;
  void (*build)(SceneBuilder&);
};

Material glossy(float metallic, float roughness, Vec3 color) {
  Material m;
  m.base_color = Vec4(color, 1);
  m.metallic = metallic;
  m.roughness = roughness;
  m.is_double_sided = true;
  return m;
}

Material emitter(Vec3 radiance) {
  Material m = glossy(0, 1, Vec3(0.3f));
  m.emission = radiance;
  m.is_double_sided = false;
  return m;
}

void add_floor(SceneBuilder& builder, std::uint32_t material) {
  builder.add_quad(Vec3(-3, -1, 3), Vec3(6, 0, 0), Vec3(0, 0, -6), material);
}

/// A big soft light above, so that naive paths find it.
void add_ceiling_light(SceneBuilder& builder, Vec3 radiance) {
  builder.add_quad(Vec3(-2, 2, -2), Vec3(4, 0, 0), Vec3(0, 0, 4), builder.add_material(emitter(radiance)));
}

void glossy_room(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.6f, 0.4f, 0.3f)), true);
  add_ceiling_light(builder, Vec3(4, 5, 6));
  builder.add_sphere(Vec3(-0.8f, 0, 0), 0.8f, builder.add_material(glossy(1, 0.25f, Vec3(0.9f, 0.7f, 0.4f))), 16);
  builder.add_sphere(Vec3(0.9f, 0, 0.2f), 0.8f, builder.add_material(glossy(0, 0.4f, Vec3(0.2f, 0.5f, 0.8f))), 16);
}

/// A sky with a bright patch, rotated, over rough plastic and a mirror.
void sky_with_sun(SceneBuilder& builder) {
  Environment& environment = builder.scene.environment;
  environment.tint = Vec3(1, 0.9f, 0.8f);
  environment.rotation = 0.7f;
  environment.image = Image(32, 16, 3);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const bool is_sun = y >= 2 && y < 5 && x >= 6 && x < 11;
      for (int c = 0; c < 3; ++c)
        environment.image.pixel(x, y)[c] = is_sun ? 12.0f : 0.2f + 0.02f * static_cast<float>(y);
    }
  }
  add_floor(builder, builder.add_material(glossy(0, 0.5f, Vec3(0.5f))));
  builder.add_sphere(Vec3(-0.8f, 0, 0), 0.8f, builder.add_material(glossy(1, 0, Vec3(0.9f))), 16);
  builder.add_sphere(Vec3(0.9f, 0, 0.2f), 0.8f, builder.add_material(glossy(0.5f, 0.3f, Vec3(0.8f, 0.2f, 0.2f))), 16);
}

/// Rough tinted glass with absorption, and a rough thin sheet in front.
void rough_glass(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.5f)), true);
  add_ceiling_light(builder, Vec3(6));
  Material glass = glossy(0, 0.5f, Vec3(0.9f, 1, 0.9f));
  glass.transmission = 1, glass.thickness = 1, glass.is_double_sided = false;
  glass.attenuation_color = Vec3(0.9f, 0.6f, 0.3f);
  glass.attenuation_distance = 0.7f;
  builder.add_sphere(Vec3(-0.8f, 0, 0), 0.8f, builder.add_material(glass), 16);
  Material sheet = glossy(0, 0.45f, Vec3(0.8f, 0.5f, 0.5f));
  sheet.transmission = 0.7f;
  builder.add_quad(Vec3(0.2f, -0.8f, 1), Vec3(1.4f, 0, 0), Vec3(0, 1.6f, 0), builder.add_material(sheet));
  builder.add_sphere(Vec3(0.9f, 0, -0.4f), 0.6f, builder.add_diffuse(Vec3(0.2f, 0.3f, 0.8f)), 16);
}

/// A lamp inside of rough dispersive glass: next-event estimation goes through its surface, at the path's wavelength.
void lamp_in_dispersive_glass(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.5f)), true);
  add_ceiling_light(builder, Vec3(3));
  Material glass = glossy(0, 0.5f, Vec3(1));
  glass.transmission = 1, glass.thickness = 1, glass.is_double_sided = false;
  glass.ior = 1.7f;
  glass.extensions.emplace().dispersion = 4;
  builder.add_sphere(Vec3(0), 1, builder.add_material(glass), 16);
  builder.add_sphere(Vec3(0.1f, 0, 0), 0.5f, builder.add_material(emitter(Vec3(4, 3, 5))), 16);
}

/// Sheets that let light through, one without a coat, and a ball with an absorbing inside around a lamp.
void translucent_things(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.5f)), true);
  add_ceiling_light(builder, Vec3(5));
  Material leaf = glossy(0, 0.4f, Vec3(0.2f, 0.6f, 0.1f));
  leaf.extensions.emplace().diffuse_transmission = 0.6f;
  leaf.extensions->diffuse_transmission_color = Vec3(0.7f, 0.9f, 0.2f);
  builder.add_quad(Vec3(-1.5f, 1, -1.5f), Vec3(3, 0, 0), Vec3(0, 0, 2), builder.add_material(leaf));
  Material paper = leaf;
  paper.specular = 0;
  builder.add_quad(Vec3(-1.5f, -0.9f, 0.8f), Vec3(1.3f, 0, 0), Vec3(0, 1, 0.2f), builder.add_material(paper));
  Material wax = leaf;
  wax.base_color = Vec4(0.8f, 0.8f, 0.7f, 1);
  wax.thickness = 1, wax.is_double_sided = false;
  wax.attenuation_color = Vec3(0.9f, 0.6f, 0.3f), wax.attenuation_distance = 0.6f;
  builder.add_sphere(Vec3(0.7f, -0.1f, 0), 0.8f, builder.add_material(wax), 16);
  builder.add_sphere(Vec3(0.6f, 0, 0), 0.3f, builder.add_material(emitter(Vec3(6, 6, 8))), 16);
}

/// A two-sided emitter whose texture, which becomes the scene's only one, leaves it partly there.
Material glowing_checks(SceneBuilder& builder, Vec3 emission, std::uint8_t last_alpha) {
  TextureImage checks;
  checks.width = checks.height = 2;
  checks.has_alpha = true;
  checks.rgba8 = {{255, 64, 0, 255}, {0, 255, 0, 40}, {10, 10, 255, 160}, {255, 255, 255, last_alpha}};
  builder.scene.images = {checks};
  builder.scene.textures = {Texture{0, Wrap::repeat, Wrap::mirror, Filter::bilinear}};
  Material glowing = glossy(0, 0.6f, Vec3(0.8f));
  glowing.emission = emission;
  glowing.emission_texture.texture = glowing.base_color_texture.texture = 0;
  glowing.alpha_mode = AlphaMode::blend;
  return glowing;
}

/// A two-sided emitter that is half there, with a texture, over holes; and an emitter that is only lit on its front.
void partly_there(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.7f)), true);
  const Material glowing = glowing_checks(builder, Vec3(5, 4, 3), 0);
  builder.add_quad(Vec3(-2, 1.5f, -2), Vec3(4, 0, 0), Vec3(0, 0, 4), builder.add_material(glowing));
  Material holes = glossy(0, 1, Vec3(0.6f));
  holes.base_color_texture.texture = 0;
  holes.alpha_mode = AlphaMode::mask;
  builder.add_quad(Vec3(-1.5f, 0.4f, -1.5f), Vec3(3, 0, 0), Vec3(0, 0, 3), builder.add_material(holes));
  builder.add_quad(Vec3(-2.9f, -2, -2), Vec3(0, 3, 0), Vec3(0, 0, 3), builder.add_material(emitter(Vec3(1, 1, 3))));
}

/// An instanced, mirrored and stretched emitter.
void instanced_light(SceneBuilder& builder) {
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.5f, 0.6f, 0.4f)), true);
  const auto mesh =
      builder.add_quad(Vec3(-1, 0, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(emitter(Vec3(4))));
  Scene& scene = builder.scene;
  Instance& first = scene.instances.back();  // the quad faces down
  first.is_world_space = false;
  first.to_world = {Mat3(1.5f, 0, 0, 0, 1, 0, 0, 0, 0.8f), Vec3(0, 2, 0)};
  const std::uint32_t object = first.object;
  // Mirrored in y: its front faces up, at the floor's side of the room it shines onto the ceiling.
  scene.instances.push_back(
      {"mirrored", object, {Mat3(0.7f, 0, 0, 0, -1, 0, 0, 0.2f, 0.7f), Vec3(0.5f, -1.5f, 0)}, false});
  EXPECT_EQ(scene.objects[object].first_mesh, mesh);
}

/// Lights of every shape, one of them textured and partly there, over an infinite floor; and a glass ball.
void shape_lights(SceneBuilder& builder) {
  const Mat3 upwards(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0)),
      downwards(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));
  const Mat3 forwards(1);
  builder.add_shape(ShapeKind::plane, {upwards, Vec3(0, -1, 0)}, builder.add_diffuse(Vec3(0.6f, 0.5f, 0.4f)));
  builder.add_shape(ShapeKind::plane, {forwards, Vec3(0, 0, -4)}, builder.add_material(emitter(Vec3(0.5f, 0.7f, 1))));
  builder.add_shape(ShapeKind::sphere, {Mat3(0.8f, 0.2f, 0, 0, 0.4f, 0, 0, 0.1f, 0.5f), Vec3(-0.9f, 0.6f, 0)},
                    builder.add_material(emitter(Vec3(6, 3, 2))));
  builder.add_shape(ShapeKind::sphere, {Mat3(0.5f), Vec3(1.3f, 0.9f, -0.5f)},
                    builder.add_material(emitter(Vec3(2, 4, 2))));
  const Material glowing = glowing_checks(builder, Vec3(3), 90);
  builder.add_shape(ShapeKind::disc, {downwards * 1.2f, Vec3(0, 2, 0.5f)}, builder.add_material(glowing));
  builder.add_shape(ShapeKind::sphere, {Mat3(0.4f), Vec3(0, -0.6f, 0.8f)}, builder.add_material(glowing));
  Material glass = glossy(0, 0, Vec3(1));
  glass.transmission = 1, glass.thickness = 1, glass.is_double_sided = false;
  builder.add_shape(ShapeKind::sphere, {Mat3(0.5f), Vec3(0.8f, -0.5f, 0.4f)}, builder.add_material(glass));
}

const NamedScene scenes[] = {{"glossy_room", glossy_room},
                             {"sky_with_sun", sky_with_sun},
                             {"rough_glass", rough_glass},
                             {"partly_there", partly_there},
                             {"instanced_light", instanced_light},
                             {"shape_lights", shape_lights},
                             {"lamp_in_dispersive_glass", lamp_in_dispersive_glass},
                             {"translucent_things", translucent_things}};

class Agreement : public testing::TestWithParam<NamedScene> {};

TEST_P(Agreement, PathHasTheMeanOfNaive) {
  SceneBuilder builder;
  GetParam().build(builder);
  const Stage stage(builder.scene);
  expect_same_mean(stage, IntegratorKind::path, IntegratorKind::naive, 0.004f);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::ValuesIn(scenes),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace candil::test

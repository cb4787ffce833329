#include "tests/support/light_scenes.h"

#include <array>
#include <ostream>

namespace candil::test {

Image uneven_image() {
  Image image(8, 4, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const float value = (x == 2 && y == 1) ? 300.0f : (x == 5 && y == 2) ? 40.0f : (x + y) % 3 == 0 ? 0.0f : 0.5f;
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = value * (1 + 0.2f * static_cast<float>(c));
    }
  }
  return image;
}

namespace {

Mesh square(float half_side) {
  Mesh mesh;
  mesh.positions = {
      {-half_side, -half_side, 0}, {half_side, -half_side, 0}, {half_side, half_side, 0}, {-half_side, half_side, 0}};
  mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A texture of 4 x 4 bytes, uneven: two bright texels in the dark.
void add_uneven_texture(Scene& scene) {
  TextureImage image;
  image.width = image.height = 4;
  for (int i = 0; i < 16; ++i) {
    const bool is_bright = i == 2 || i == 9;
    image.rgba8.emplace_back(is_bright ? 255 : 12 * i, is_bright ? 250 : 100, 5 * i, 255);
  }
  scene.images.push_back(image);
  scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), Wrap::clamp, Wrap::clamp});
}

void add_one_sided(SceneBuilder& builder) {
  // Above the origin, front downwards.
  builder.add_quad(Vec3(-1, 2, -0.5f), Vec3(1.5f, 0, 0), Vec3(0, 0.3f, 1),
                   builder.add_material(emitter(Vec3(3, 2, 1))));
}

void add_facing_away(SceneBuilder& builder) {
  builder.add_quad(Vec3(-1, 2.5f, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_material(emitter(Vec3(9))));
}

void add_two_sided(SceneBuilder& builder) {
  builder.add_quad(Vec3(-1.5f, 0.5f, -2), Vec3(1, 0, 0), Vec3(0.2f, 1, 0), builder.add_diffuse(Vec3(0), Vec3(1, 4, 2)));
}

void add_textured(SceneBuilder& builder) {
  add_uneven_texture(builder.scene);
  Material material = emitter(Vec3(8, 6, 10));
  material.emission_texture.texture = 0;
  builder.add_quad(Vec3(-1, 1.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(material));
}

void add_blended(SceneBuilder& builder) {
  add_uneven_texture(builder.scene);
  for (glm::u8vec4& texel : builder.scene.images[0].rgba8) texel.w = texel.x;
  Material material = emitter(Vec3(4));
  material.base_color_texture.texture = 0;
  material.alpha_mode = AlphaMode::blend;
  material.is_double_sided = true;
  builder.add_quad(Vec3(-1, 1.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(material));
}

/// One square used three times: moved, mirrored, stretched. All fronts but the last one's see the origin.
void add_instanced(SceneBuilder& builder) {
  builder.add_mesh(square(0.5f), builder.add_material(emitter(Vec3(5, 5, 2))));
  const Mat3 down(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));          // +z turned to -y
  const Mat3 stretched(Vec3(0, 0, -2), Vec3(0, 0.5f, 0), Vec3(1, 0, 0));  // +z turned to +x
  const Mat3 mirrored(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  builder.scene.instances = {{"", 0, Affine{down, Vec3(0.5f, 2, 0)}, false},
                             {"", 0, Affine{mirrored, Vec3(0, 0.5f, -2)}, false},
                             {"", 0, Affine{stretched, Vec3(-2, 0.2f, 0)}, false},
                             {"", 0, Affine{mirrored * 2.0f, Vec3(0, 0.5f, 2)}, false}};
}

void add_constant_environment(SceneBuilder& builder) { builder.scene.environment.tint = Vec3(0.5f, 1, 2); }

void add_image_environment(SceneBuilder& builder) {
  builder.scene.environment.tint = Vec3(1, 2, 0.5f);
  builder.scene.environment.image = uneven_image();
  builder.scene.environment.rotation = 1.1f;
}

void add_everything(SceneBuilder& builder) {
  add_textured(builder);
  add_two_sided(builder);
  add_facing_away(builder);
  add_image_environment(builder);
  PunctualLight lamp;
  lamp.intensity = Vec3(20);
  lamp.position = Vec3(1, 2, 1);
  builder.scene.punctual_lights = {lamp};
}

constexpr std::array scenes = {
    LightScene{"one_sided", add_one_sided},
    LightScene{"facing_away", add_facing_away},
    LightScene{"two_sided", add_two_sided},
    LightScene{"textured", add_textured},
    LightScene{"blended", add_blended},
    LightScene{"instanced", add_instanced},
    LightScene{"constant_environment", add_constant_environment},
    LightScene{"image_environment", add_image_environment},
    LightScene{"everything", add_everything},
};

}  // namespace

SurfacePoint point_at(Vec3 position, Vec3 normal) {
  SurfacePoint point;
  point.position = position;
  point.normal = point.normal_geometric = normal;
  return point;
}

Material emitter(Vec3 radiance) {
  Material material;
  material.emission = radiance;
  return material;
}

void PrintTo(const LightScene& scene, std::ostream* stream) { *stream << scene.name; }

std::span<const LightScene> light_scenes() { return scenes; }

}  // namespace candil::test

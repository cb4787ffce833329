/// What JSON scenes become.
#include <gtest/gtest.h>

#include "core/metals.h"
#include "tests/io/json_sample.h"
#include "tests/support/expect_near.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

Material only_material(const std::string& material, const std::string& root = "") {
  const LoadedScene loaded = load_json("{" + root + R"("objects": [{"type": "sphere", "center": [0, 0, 0],
    "radius": 1, "material": )" + material +
                                       "}]}");
  EXPECT_EQ(loaded.scene.materials.size(), 1U);
  return loaded.scene.materials.at(0);
}

TEST(JsonScene, CommentsAndByteOrderMark) {
  const LoadedScene loaded = load_json("\xEF\xBB\xBF// first\n{/* none */ \"objects\": [] // last\n}");
  EXPECT_TRUE(loaded.scene.shapes.empty());
  EXPECT_FALSE(loaded.is_lit);
}

TEST(JsonScene, GltfNamedJsonIsGltf) {
  GltfSample sample;
  sample.add_triangle();
  EXPECT_EQ(load_json(sample.json()).scene.meshes.size(), 1U);
}

// The kind of a file is told from its root alone, however deep the rest is.
TEST(JsonScene, OnlyTheRootTellsGltf) {
  EXPECT_EQ(json_error(R"({"render": {"asset": 1}})").rfind("scene.json: render.asset: is not known", 0), 0U);
  EXPECT_EQ(json_error(R"({"asset": )" + std::string(1'000'000, '[')),
            "scene.json: JSON: is nested deeper than 128 levels");
}

TEST(JsonShape, SphereAndInstances) {
  const LoadedScene loaded = load_json(R"({"objects": [{"type": "sphere", "name": "ball", "center": [1, 2, 3],
    "radius": 2, "instances": [[], [{"rotate_y": 90}, {"translate": [0, 10, 0]}]]}]})");
  ASSERT_EQ(loaded.scene.shapes.size(), 2U);
  const Shape& first = loaded.scene.shapes[0];
  EXPECT_EQ(first.kind, ShapeKind::sphere);
  EXPECT_EQ(first.name, "ball");
  expect_near(first.to_world.point(Vec3(0, 0, 1)), Vec3(1, 2, 5));
  // A quarter turn about +Y takes +Z to +X and +X to -Z: the centre (1, 2, 3) to (3, 2, -1), then 10 m up.
  expect_near(loaded.scene.shapes[1].to_world.point(Vec3(0)), Vec3(3, 12, -1));
  EXPECT_EQ(loaded.scene.materials.size(), 1U);
}

// Local +Z is the front, x and y the directions of one image to the right and up.
TEST(JsonShape, PlaneFrame) {
  const auto plane = [](const std::string& members) {
    return load_json(R"({"objects": [{"type": "plane", "point": [1, 2, 3], )" + members + "}]}")
        .scene.shapes.at(0)
        .to_world;
  };
  const Affine given = plane(R"("normal": [0, 3, 0], "u": [0, 0, 2], "v": [5, 0, 0])");
  expect_near(given.point(Vec3(1, 1, 1)), Vec3(1, 2, 3) + Vec3(0, 0, 2) + Vec3(5, 0, 0) + Vec3(0, 1, 0));
  const Affine floor = plane(R"("normal": [0, 1, 0])");
  expect_near(floor.vector(Vec3(1, 0, 0)), Vec3(1, 0, 0));
  expect_near(floor.vector(Vec3(0, 1, 0)), Vec3(0, 0, -1));
  const Affine wall = plane(R"("normal": [-1, 0, 0])");  // upright images on a wall that faces -X
  expect_near(wall.vector(Vec3(0, 1, 0)), Vec3(0, 1, 0));
  expect_near(wall.vector(Vec3(1, 0, 0)), Vec3(0, 0, 1));  // to the right of who looks along +X
}

TEST(JsonShape, DiscFacesItsNormal) {
  const Affine disc = load_json(R"({"objects": [{"type": "disc", "center": [0, 4, 0], "normal": [0, -2, 0],
    "radius": 3}]})")
                          .scene.shapes.at(0)
                          .to_world;
  expect_near(disc.point(Vec3(0)), Vec3(0, 4, 0));
  expect_near(disc.vector(Vec3(0, 0, 1)), Vec3(0, -3, 0));
}

// The fourth corner makes a parallelogram; both halves face the viewer who named the corners.
TEST(JsonMesh, QuadFromThreeCorners) {
  const Scene scene =
      load_json(R"({"objects": [{"type": "quad", "corners": [[0, 1, 0], [2, 1.5, 0], [0, 0, 0]]}]})").scene;
  ASSERT_EQ(scene.meshes.size(), 1U);
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.positions.size(), 4U);
  expect_near(mesh.positions[3], Vec3(2, 0.5f, 0));
  EXPECT_EQ(mesh.uvs[0][0], Vec2(0, 0));  // upper left
  EXPECT_EQ(mesh.uvs[0][3], Vec2(1, 1));
  float area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t.x], cross = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    EXPECT_GT(cross.z, 0);
    area += 0.5f * glm::length(cross);
  }
  EXPECT_NEAR(area, 2, 1e-6f);  // base 2 along x, height 1: the shear does not count
}

TEST(JsonMesh, InstancesShareTheMesh) {
  const Scene scene = load_json(R"({"objects": [{"type": "triangle", "vertices": [[0,0,0],[1,0,0],[0,1,0]],
    "transform": [{"scale": 2}], "instances": [[{"translate": [1, 0, 0]}], [{"translate": [0, 5, 0]}]]}]})")
                          .scene;
  EXPECT_EQ(scene.meshes.size(), 1U);
  ASSERT_EQ(scene.instances.size(), 2U);
  // `transform` comes first: 2 * 1 + 1.
  expect_near(scene.instances[0].to_world.point(Vec3(1, 0, 0)), Vec3(3, 0, 0));
  expect_near(scene.instances[1].to_world.point(Vec3(1, 0, 0)), Vec3(2, 5, 0));
}

TEST(JsonTransform, StepsActInOrder) {
  const auto moved = [](const std::string& steps, const std::string& point) {
    return load_json(R"({"objects": [{"type": "sphere", "center": )" + point + R"(, "radius": 1, "transform": [)" +
                     steps + "]}]}")
        .scene.shapes.at(0)
        .to_world.translation;
  };
  expect_near(moved(R"({"translate": [1, 0, 0]}, {"rotate_z": 90})", "[0, 0, 0]"), Vec3(0, 1, 0));
  expect_near(moved(R"({"rotate_z": 90}, {"translate": [1, 0, 0]})", "[0, 0, 0]"), Vec3(1, 0, 0));
  expect_near(moved(R"({"rotate_x": 90})", "[0, 1, 0]"), Vec3(0, 0, 1));
  expect_near(moved(R"({"rotate_y": 90})", "[0, 0, 1]"), Vec3(1, 0, 0));
  // A third of a turn about the diagonal permutes the axes.
  expect_near(moved(R"({"rotate": {"axis": [1, 1, 1], "angle": 120}})", "[1, 2, 3]"), Vec3(3, 1, 2));
  expect_near(moved(R"({"scale": [1, -2, 3]})", "[1, 1, 1]"), Vec3(1, -2, 3));
  expect_near(moved(R"({"matrix": [[0, 2, 0, 7], [1, 0, 0, 8], [0, 0, 1, 9]]})", "[1, 2, 3]"), Vec3(11, 9, 12));
}

TEST(JsonMaterial, EachTypeBecomesItsModel) {
  const Material lambertian = only_material(R"({"type": "lambertian", "kd": [0.1, 0.2, 0.3]})");
  EXPECT_EQ(Vec3(lambertian.base_color), Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(lambertian.specular, 0);
  EXPECT_EQ(lambertian.metallic, 0);
  EXPECT_TRUE(lambertian.is_double_sided);
  const Material mirror = only_material(R"({"type": "mirror", "ks": 0.9, "double_sided": false})");
  EXPECT_EQ(mirror.model, MaterialModel::phong);
  EXPECT_EQ(mirror.phong_exponent, infinity);
  EXPECT_TRUE(is_black(Vec3(mirror.base_color)));
  EXPECT_EQ(mirror.specular_color, Vec3(0.9f));
  EXPECT_FALSE(mirror.is_double_sided);
  const Material phong = only_material(R"({"type": "phong", "kd": 0.65, "ks": 0.2, "exponent": 50})");
  EXPECT_EQ(phong.model, MaterialModel::phong);
  EXPECT_EQ(phong.phong_exponent, 50);
  EXPECT_EQ(Vec3(phong.base_color), Vec3(0.65f));
  EXPECT_EQ(phong.specular_color, Vec3(0.2f));
  const Material conductor = only_material(R"({"type": "conductor", "eta": 0.2, "k": [4, 3, 2], "roughness": 0.3})");
  EXPECT_EQ(conductor.model, MaterialModel::conductor);
  EXPECT_EQ(conductor.conductor_eta, Vec3(0.2f));
  EXPECT_EQ(conductor.conductor_k, Vec3(4, 3, 2));
  const Material gold = only_material(R"({"type": "conductor", "metal": "gold"})", R"("medium": {"ior": 2}, )");
  EXPECT_EQ(gold.model, MaterialModel::conductor);
  EXPECT_EQ(gold.conductor_eta, find_metal("Au")->eta / 2.0f);  // against what is around it
  EXPECT_EQ(gold.conductor_k, find_metal("Au")->k / 2.0f);
  for (const Metal& metal : metals())
    for (const std::string_view name : {metal.name, metal.symbol})
      EXPECT_EQ(only_material(R"({"type": "conductor", "metal": ")" + std::string(name) + "\"}").conductor_k, metal.k);
  const Material emitter = only_material(R"({"type": "emitter", "emission": [3, 2, 1]})");
  EXPECT_EQ(emitter.emission, Vec3(3, 2, 1));
  EXPECT_TRUE(is_black(Vec3(emitter.base_color)));
}

TEST(JsonMaterial, IndicesAreRelativeToTheMedium) {
  const std::string air = R"("medium": {"ior": 1.25}, )";
  const Material glass =
      only_material(R"({"type": "dielectric", "ior": 1.5, "attenuation": {"color": 0.5, "distance": 2}})", air);
  EXPECT_NEAR(glass.ior, 1.2f, 1e-6f);
  EXPECT_TRUE(glass.is_volume());
  EXPECT_EQ(glass.roughness, 0);
  EXPECT_EQ(glass.attenuation_distance, 2);
  EXPECT_NEAR(only_material(R"({"type": "metallic-roughness"})", air).ior, 1.2f, 1e-6f);
  EXPECT_FALSE(only_material(R"({"type": "metallic-roughness", "transmission": 1, "thin": true})").is_volume());
}

TEST(JsonMaterial, NamesAreSharedAndReplaced) {
  const TemporaryFolder folder;
  write_text(folder / "ball.json", R"({"materials": {"m": {"type": "mirror"}}, "camera": {"look_from": [0, 0, 9],
    "look_at": [0, 0, 0]}, "render": {"spp": 4, "size": [8, 6]}, "objects": [{"type": "sphere", "center": [0, 0, 0],
    "radius": 1, "material": "m"}]})");
  const LoadedScene loaded = load_json(folder, R"({"include": ["ball.json", "ball.json"], "render": {"spp": 7},
    "materials": {"m": {"type": "lambertian", "kd": 0.25}},
    "objects": [{"type": "sphere", "center": [3, 0, 0], "radius": 1, "material": "m"}]})");
  ASSERT_EQ(loaded.scene.shapes.size(), 2U) << "a file included twice counts once";
  ASSERT_EQ(loaded.scene.materials.size(), 1U);
  EXPECT_EQ(loaded.scene.materials[0].base_color.x, 0.25f);
  EXPECT_EQ(loaded.scene.materials[0].name, "m");
  EXPECT_EQ(loaded.render_defaults.samples_per_pixel, 7U);
  EXPECT_EQ(loaded.render_defaults.size, (std::array<int, 2>{8, 6}));
  EXPECT_EQ(loaded.scene.cameras.size(), 1U);
}

TEST(JsonCamera, LooksWhereItSays) {
  const Scene scene = load_json(R"({"camera": {"look_from": [0, 0, 5], "look_at": [0, 0, 1], "fov": 90, "blades": 5,
    "lens_radius": 0.1, "focus_at": [7, 0, 2]}, "cameras": [{"name": "down", "look_from": [0, 9, 0],
    "look_at": [0, 0, 0], "height": 4}]})")
                          .scene;
  ASSERT_EQ(scene.cameras.size(), 2U);
  const Camera& first = scene.cameras[0];
  EXPECT_NEAR(first.yfov, pi / 2, 1e-6f);
  expect_near(-first.to_world.linear[2], Vec3(0, 0, -1));
  expect_near(first.to_world.linear[1], Vec3(0, 1, 0));
  EXPECT_NEAR(first.focus_distance, 3, 1e-6f);  // along the axis: from z = 5 to z = 2
  EXPECT_EQ(first.lens_radius, 0.1f);
  EXPECT_EQ(first.lens_blades, 5);
  const Camera& down = scene.cameras[1];
  EXPECT_EQ(down.kind, CameraKind::orthographic);
  EXPECT_EQ(down.ymag, 2);
  expect_near(-down.to_world.linear[2], Vec3(0, -1, 0));
  EXPECT_EQ(down.focus_distance, 9);
}

TEST(JsonLight, UnitsAndDirections) {
  const LoadedScene loaded = load_json(R"({"lights": [
    {"type": "point", "position": [1, 2, 3], "power": [12.566371, 0, 25.132741]},
    {"type": "spot", "position": [0, 0, 0], "direction": [0, 0, 9], "intensity": 2, "inner_angle": 30, "outer_angle": 60},
    {"type": "directional", "direction": [0, -2, 0], "irradiance": [1, 2, 3]}]})");
  EXPECT_TRUE(loaded.is_lit);
  const std::vector<PunctualLight>& lights = loaded.scene.punctual_lights;
  ASSERT_EQ(lights.size(), 3U);
  expect_near(lights[0].intensity, Vec3(1, 0, 2));  // 4 pi W make 1 W/sr
  expect_near(lights[1].direction, Vec3(0, 0, 1));
  EXPECT_NEAR(lights[1].outer_cone, pi / 3, 1e-6f);
  EXPECT_NEAR(lights[1].inner_cone, pi / 6, 1e-6f);
  EXPECT_EQ(lights[2].kind, PunctualKind::directional);
  EXPECT_EQ(lights[2].intensity, Vec3(1, 2, 3));
}

TEST(JsonGltf, IsPlacedAndImmersed) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"name":"own"})"};
  write_text(folder / "model.gltf", sample.json());
  const std::string text = R"({"medium": {"ior": 1.2}, "objects": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1},
    {"type": "gltf", "file": "model.gltf", "instances": [[{"translate": [5, 0, 0]}], [{"scale": 2}]]},
    {"type": "gltf", "file": "model.gltf", "transform": [{"translate": [0, 0, 4]}], "material": {"type": "mirror"}}]})";
  const Scene scene = load_json(folder, text).scene;
  ASSERT_EQ(scene.meshes.size(), 2U);
  ASSERT_EQ(scene.instances.size(), 3U);
  EXPECT_EQ(scene.materials[scene.meshes[0].material].name, "own");
  EXPECT_NEAR(scene.materials[scene.meshes[0].material].ior, 1.25f, 1e-6f);
  EXPECT_EQ(scene.materials[scene.meshes[1].material].model, MaterialModel::phong);
  expect_near(scene.instances[0].to_world.point(scene.meshes[0].positions[0]), Vec3(5, 0, 0));
  expect_near(scene.meshes[1].positions[1], Vec3(1, 0, 4));  // used once, hence baked
  EXPECT_TRUE(scene.instances[2].is_world_space);
}

}  // namespace
}  // namespace candil::test

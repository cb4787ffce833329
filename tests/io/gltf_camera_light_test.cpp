#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

TEST(GltfCamera, ReadsBothKinds) {
  GltfSample sample;
  sample.cameras = {R"({"type":"perspective","name":"main","perspective":{"yfov":0.5,"aspectRatio":1.5,"znear":0.1}})",
                    R"({"type":"orthographic","orthographic":{"xmag":4,"ymag":-2,"zfar":10,"znear":0}})"};
  sample.nodes = {R"({"camera":1,"name":"side","translation":[1,2,3]})", R"({"camera":0})"};
  const std::vector<Camera> cameras = load_sample(sample).scene.cameras;
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name, "side") << "the node's name where the camera has none";
  EXPECT_EQ(cameras[0].kind, CameraKind::orthographic);
  EXPECT_EQ(cameras[0].xmag, 4);
  EXPECT_EQ(cameras[0].ymag, 2);
  EXPECT_EQ(cameras[0].to_world.translation, Vec3(1, 2, 3));
  EXPECT_EQ(cameras[1].name, "main");
  EXPECT_EQ(cameras[1].yfov, 0.5f);
  EXPECT_EQ(cameras[1].aspect, 1.5f);
}

// Without zfar the projection is infinite; rays have no clipping planes in any case.
TEST(GltfCamera, ClippingPlanesMeanNothing) {
  GltfSample sample;
  sample.cameras = {R"({"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}})",
                    R"({"type":"perspective","perspective":{"yfov":0.5,"znear":0.1,"zfar":0.2}})"};
  sample.nodes = {R"({"camera":0})", R"({"camera":1})"};
  const LoadedScene loaded = load_sample(sample);
  ASSERT_EQ(loaded.scene.cameras.size(), 2u);
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.scene.cameras[0].yfov, loaded.scene.cameras[1].yfov);
}

TEST(GltfCamera, IgnoresThoseThatCanShowNothing) {
  GltfSample sample;
  sample.cameras = {R"({"type":"perspective","perspective":{"yfov":0,"znear":0.1}})",
                    R"({"type":"perspective","perspective":{"yfov":3.2,"znear":0.1}})",
                    R"({"type":"orthographic","orthographic":{"xmag":0,"ymag":1,"zfar":10,"znear":0}})"};
  sample.nodes = {R"({"camera":0})", R"({"camera":1})", R"({"camera":2})"};
  const LoadedScene loaded = load_sample(sample);
  EXPECT_TRUE(loaded.scene.cameras.empty());
  EXPECT_EQ(loaded.warnings.size(), 3u);
  sample.cameras = {R"({"type":"fisheye"})"};
  EXPECT_EQ(load_error(sample), "model.gltf: cameras[0].type: \"fisheye\" is none of: perspective orthographic");
}

// Each would begin or aim its rays where single precision ends.
TEST(GltfCamera, IgnoresThoseOutOfReach) {
  const std::string perspective = R"({"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}})";
  for (const char* const node : {R"("translation":[0,0,1e10])", R"("scale":[0,0,0])", R"("scale":[1,0,1])",
                                 R"("scale":[1,1,1e-30])", R"("matrix":[1,0,0,0, 0,1,0,0, 0,1,0,0, 0,0,0,1])"}) {
    GltfSample sample;
    sample.cameras = {perspective};
    sample.nodes = {R"({"camera":0,)" + std::string(node) + "}"};
    const LoadedScene loaded = load_sample(sample);
    EXPECT_TRUE(loaded.scene.cameras.empty()) << node;
    EXPECT_EQ(loaded.warnings,
              std::vector<std::string>{
                  "nodes[0].camera: is too far away, scaled to nothing or frames too much; it is ignored"})
        << node;
  }
  for (const char* const frame :
       {R"("xmag":1e10,"ymag":1e10)", R"("xmag":1,"ymag":1e-30)", R"("xmag":1e20,"ymag":1)"}) {
    GltfSample sample;
    sample.cameras = {R"({"type":"orthographic","orthographic":{)" + std::string(frame) + R"(,"zfar":10,"znear":0}})"};
    sample.nodes = {R"({"camera":0})"};
    EXPECT_TRUE(load_sample(sample).scene.cameras.empty()) << frame;
  }
  GltfSample sample;  // a scaled and mirrored one is fine
  sample.cameras = {perspective};
  sample.nodes = {R"({"camera":0,"translation":[1e9,0,0],"scale":[-1e-6,1e-6,1e-6]})"};
  EXPECT_EQ(load_sample(sample).scene.cameras.size(), 1u);
}

TEST(GltfLight, IgnoresThoseOutOfReach) {
  GltfSample sample;
  sample.root = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
      {"type":"point"},{"type":"directional"}]}})";
  sample.nodes = {R"({"translation":[0,1e10,0],"extensions":{"KHR_lights_punctual":{"light":0}}})",
                  R"({"translation":[0,1e10,0],"extensions":{"KHR_lights_punctual":{"light":1}}})"};
  const LoadedScene loaded = load_sample(sample);
  ASSERT_EQ(loaded.scene.punctual_lights.size(), 1u);
  EXPECT_EQ(loaded.scene.punctual_lights[0].kind, PunctualKind::directional) << "its place has no meaning";
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

// The node turns -Z to +X (a quarter about -Y: rotation (0, -sin 45, 0, cos 45)) and doubles everything, which must not
// change the unit direction.
TEST(GltfLight, ReadsPunctualLights) {
  GltfSample sample;
  sample.root = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
      {"type":"point","color":[1,0.5,0],"intensity":40,"range":7},
      {"type":"spot","name":"stage","intensity":2,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
      {"type":"directional"}]}})";
  const auto node = [](int light) {
    return "{\"name\":\"n\",\"translation\":[1,2,3],\"scale\":[2,2,2],\"rotation\":[0,-0.70710678,0,0.70710678],"
           "\"extensions\":{\"KHR_lights_punctual\":{\"light\":" +
           std::to_string(light) + "}}}";
  };
  sample.nodes = {node(0), node(1), node(2)};
  const LoadedScene loaded = load_sample(sample);
  EXPECT_TRUE(loaded.warnings.empty());
  const std::vector<PunctualLight>& lights = loaded.scene.punctual_lights;
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_EQ(lights[0].kind, PunctualKind::point);
  EXPECT_EQ(lights[0].name, "n");
  EXPECT_EQ(lights[0].intensity, Vec3(40, 20, 0));
  EXPECT_EQ(lights[0].range, 7);
  EXPECT_EQ(lights[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(lights[1].kind, PunctualKind::spot);
  EXPECT_EQ(lights[1].name, "stage");
  EXPECT_EQ(lights[1].inner_cone, 0.1f);
  EXPECT_EQ(lights[1].outer_cone, 0.2f);
  EXPECT_EQ(lights[2].kind, PunctualKind::directional);
  EXPECT_EQ(lights[2].intensity, Vec3(1)) << "white and 1 lux by default";
  EXPECT_EQ(lights[2].range, infinity);
  EXPECT_NEAR(glm::length(lights[2].direction - Vec3(1, 0, 0)), 0, 1e-6f);
}

// A lamp of 1000 W and a sun of 3 W/m2 in Blender, as its exporter writes them. 683 lm/W and 4 pi sr: candela are 683 *
// 1000 / (4 pi), W/sr 1000 / (4 pi); lux are 683 * 3.
TEST(GltfLight, KnowsTheUnitsOfBlender) {
  const auto load = [](const std::string& lamp, const std::string& sun, LightUnits units) {
    GltfSample sample;
    sample.root = R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[1,0.5,0],"intensity":)" +
                  lamp + R"(},{"type":"spot","spot":{},"intensity":)" + lamp + R"(},{"type":"directional","intensity":)" + sun +
                  "}]}}";
    for (const char* const light : {"0", "1", "2"})
      sample.nodes.push_back(R"({"extensions":{"KHR_lights_punctual":{"light":)" + std::string(light) + "}}}");
    LoadOptions options;
    options.light_units = units;
    return load_sample(sample, options).scene.punctual_lights;
  };
  for (const auto& lights : {load("54351.413", "2049", LightUnits::spec), load("79.577472", "3", LightUnits::compat),
                             load("1000", "3", LightUnits::raw)}) {
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_NEAR(lights[0].intensity.x, 54351.413f, 0.02f);
    EXPECT_NEAR(lights[0].intensity.y, 54351.413f / 2, 0.02f);
    EXPECT_NEAR(lights[1].intensity.x, 54351.413f, 0.02f);
    EXPECT_NEAR(lights[2].intensity.x, 2049, 1e-3f);
  }
}

TEST(GltfLight, ClampsAnglesAndNegativeIntensity) {
  GltfSample sample;
  sample.root = R"(,"extensions":{"KHR_lights_punctual":{"lights":[
      {"type":"spot","intensity":-5,"range":-1,"spot":{"innerConeAngle":0.5,"outerConeAngle":0.25}}]}})";
  sample.nodes = {R"({"extensions":{"KHR_lights_punctual":{"light":0}}})"};
  const LoadedScene loaded = load_sample(sample);
  ASSERT_EQ(loaded.scene.punctual_lights.size(), 1u);
  const PunctualLight& light = loaded.scene.punctual_lights[0];
  EXPECT_EQ(light.intensity, Vec3(0));
  EXPECT_EQ(light.range, infinity);
  EXPECT_EQ(light.inner_cone, 0.25f);
  EXPECT_EQ(loaded.warnings.size(), 3u);
}

TEST(GltfLight, RefusesLightsThatDoNotExist) {
  GltfSample sample;
  sample.nodes = {R"({"extensions":{"KHR_lights_punctual":{"light":0}}})"};
  EXPECT_EQ(load_error(sample),
            "model.gltf: nodes[0].extensions.KHR_lights_punctual.light: index 0 does not exist: there are 0 in lights");
}

}  // namespace
}  // namespace candil::test

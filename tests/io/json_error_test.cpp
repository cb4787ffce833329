/// Wrong JSON scenes: each message names the file, the place and what to do.
#include <gtest/gtest.h>

#include "tests/io/json_sample.h"

namespace candil::test {
namespace {

struct WrongScene {
  std::string text, message;
};

void PrintTo(const WrongScene& wrong, std::ostream* out) { *out << wrong.message; }

class JsonError : public testing::TestWithParam<WrongScene> {};

TEST_P(JsonError, NamesThePlace) { EXPECT_EQ(json_error(GetParam().text), "scene.json: " + GetParam().message); }

const std::string sphere = R"({"type": "sphere", "center": [0, 0, 0], "radius": 1})";

INSTANTIATE_TEST_SUITE_P(
    Schema, JsonError,
    testing::Values(
        WrongScene{R"({"objects": [)" + sphere + "," + sphere + "," + sphere +
                       R"(, {"type": "sphere", "center": [0, 0, 0], "radius": 0}]})",
                   "objects[3].radius: must be > 0"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0, 0, 0], "raduis": 1}]})",
                   "objects[0].raduis: is not known; did you mean \"radius\"?"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0, 0, 0]}]})", "objects[0].radius: is missing"},
        WrongScene{R"({"objects": [{"type": "spere"}]})",
                   "objects[0].type: \"spere\" is not known; did you mean \"sphere\"?"},
        WrongScene{R"({"objects": [{"center": [0, 0, 0]}]})", "objects[0].type: is missing"},
        WrongScene{R"({"objects": [{"type": 7}]})", "objects[0].type: must be a string"},
        WrongScene{R"({"objects": [7]})", "objects[0]: must be an object"},
        WrongScene{R"({"objects": {}})", "objects: must be an array"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0, 0], "radius": 1}]})",
                   "objects[0].center: must have 3 elements, has 2"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0, 1e10, 0], "radius": 1}]})",
                   "objects[0].center[1]: must be <= 1e+09"},
        WrongScene{R"({"materials": {"a": {"type": "lambertian", "kd": "red"}}})",
                   "materials.a.kd: must be a number, an array or an object"},
        WrongScene{R"({"materials": {"a": {"type": "lambertian", "kd": [0.5, 1.5, 0]}}})",
                   "materials.a.kd[1]: must be <= 1"},
        WrongScene{R"({"materials": {"a": {"type": "dielectric", "ior": 0.9}}})", "materials.a.ior: must be >= 1"},
        WrongScene{R"({"materials": {"a": {"type": "conductor", "metal": "glod"}}})",
                   "materials.a.metal: \"glod\" is not known; did you mean \"gold\"?"},
        WrongScene{R"({"materials": {"a": {"type": "conductor"}}})", "materials.a: must have \"metal\" or \"eta\""},
        WrongScene{R"({"materials": {"a": {"type": "conductor", "eta": 1}}})", "materials.a.k: is missing"},
        WrongScene{R"({"materials": {"a\nb": {"type": "mirror", "ks": 2}}})", "materials.a?b.ks: must be <= 1"},
        WrongScene{R"({"textures": {"a": {"wrap": "clamp"}}})", "textures.a: must have \"image\" or \"checkerboard\""},
        WrongScene{R"({"textures": {"a": {"image": "a.png", "wrap": "clmap"}}})",
                   "textures.a.wrap: \"clmap\" is not known; did you mean \"clamp\"?"},
        WrongScene{R"({"objects": [{"type": "quad", "corners": [[0,0,0],[1,0,0],[0,1,0]], "transform": [{}]}]})",
                   "objects[0].transform[0]: must have \"translate\", \"rotate_x\", \"rotate_y\", \"rotate_z\", "
                   "\"rotate\", \"scale\" or \"matrix\""},
        WrongScene{R"({"render": {"spp": 1.5}})", "render.spp: must be an integer"},
        WrongScene{R"({"objects": [{"type": "quad", "corners": [[0,0,0],[1,0,0],[0,1,0]], "instances": []}]})",
                   "objects[0].instances: must have at least 1 elements, has 0"},
        WrongScene{R"({"render": {"spp": true}})", "render.spp: must be an integer"},
        WrongScene{R"({"xyzzy": 1})",
                   "xyzzy: is not known; known: \"$schema\", \"camera\", \"cameras\", \"environment\", \"include\", "
                   "\"lights\", \"materials\", \"medium\", \"objects\", \"render\" or \"textures\""},
        WrongScene{"[]", "must be an object"}));

INSTANTIATE_TEST_SUITE_P(
    Meaning, JsonError,
    testing::Values(
        WrongScene{R"({"materials": {"red": {"type": "mirror"}}, "objects": [{"type": "sphere", "center": [0,0,0],
                   "radius": 1, "material": "rde"}]})",
                   "objects[0].material: \"rde\" is none of the materials; did you mean \"red\"?"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0,0,0], "radius": 1,
                   "material": {"type": "plastic", "kd": [0.5, 0.9, 0.5], "ks": 0.25}}]})",
                   "objects[0].material: kd + ks must be <= 1, is 0.9 + 0.25 in green"},
        WrongScene{R"({"textures": {"t": {"checkerboard": [0.9, 0.1]}}, "objects": [{"type": "sphere",
                   "center": [0,0,0], "radius": 1, "material": {"type": "phong", "exponent": 9,
                   "kd": {"texture": "t"}, "ks": 0.25}}]})",
                   "objects[0].material: kd + ks must be <= 1, is 0.9 + 0.25 in red"},
        WrongScene{R"({"objects": [{"type": "quad", "corners": [[0,0,0],[1,1,1],[2,2,2]]}]})",
                   "objects[0].corners: must not lie on one line"},
        WrongScene{R"({"objects": [{"type": "plane", "point": [0,0,0], "normal": [0,0,0]}]})",
                   "objects[0].normal: must not be zero"},
        WrongScene{R"({"objects": [{"type": "plane", "point": [0,0,0], "normal": [0,1,0], "u": [1,1,0]}]})",
                   "objects[0].u: must be at right angles to the normal"},
        WrongScene{R"({"objects": [{"type": "plane", "point": [0,0,0], "normal": [0,1,0], "u": [1,0,0],
                   "v": [-2,0,0]}]})",
                   "objects[0].v: must not be parallel to \"u\""},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0,0,0], "radius": 1,
                   "instances": [[], [{"scale": [1, 0, 1]}]]}]})",
                   "objects[0].instances[1]: must be invertible: it scales to nothing or beyond all numbers"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0,0,0], "radius": 1,
                   "transform": [{"scale": [1e-9, 1, 1]}]}]})",
                   "objects[0].transform: must be invertible: it scales to nothing or beyond all numbers"},
        WrongScene{R"({"objects": [{"type": "sphere", "center": [0,0,0], "radius": 1,
                   "transform": [{"scale": 1e5}, {"scale": 1e5}]}]})",
                   "objects[0]: reaches farther than 1e9 m from the origin"},
        WrongScene{R"({"camera": {"look_from": [0,0,0], "look_at": [0,0,0]}})",
                   "camera.look_at: must differ from \"look_from\""},
        WrongScene{R"({"camera": {"look_from": [0,0,0], "look_at": [0,0,1], "fov": 30, "height": 1}})",
                   "camera.height: must not stand beside \"fov\""},
        WrongScene{R"({"camera": {"look_from": [0,0,0], "look_at": [0,0,1], "focus_at": [0,0,-1]}})",
                   "camera.focus_at: must lie in front of the camera"},
        WrongScene{R"({"lights": [{"type": "point", "position": [0,0,0], "power": 1, "intensity": 1}]})",
                   "lights[0].power: must not stand beside \"intensity\""},
        WrongScene{R"({"lights": [{"type": "spot", "position": [0,0,0], "direction": [0,0,1], "inner_angle": 50}]})",
                   "lights[0].inner_angle: must not exceed \"outer_angle\""},
        WrongScene{R"({"environment": {"image": "../sky.hdr"}})",
                   "environment.image: \"../sky.hdr\" leaves the folder of the scene file"},
        WrongScene{R"({"objects": [{"type": "gltf", "file": "/tmp/a.glb"}]})",
                   "objects[0].file: \"/tmp/a.glb\" is an absolute path; only files beside the scene are read"},
        WrongScene{R"({"include": ["scene.json"]})", "include[0]: includes itself"},
        WrongScene{R"({"include": ["none.json"]})", "include[0]: \"none.json\" does not exist"}));

INSTANTIATE_TEST_SUITE_P(
    Text, JsonError,
    testing::Values(WrongScene{R"({"medium": {}, "medium": {}})", "JSON: the key \"medium\" is twice in one object"},
                    WrongScene{std::string(100000, '['), "JSON: is nested deeper than 64 levels"}));

TEST(JsonSyntax, NamesLineAndColumn) {
  const std::string message = json_error("{\n  \"objects\": [,]\n}");
  EXPECT_EQ(message.find("scene.json: JSON: parse error at line 2, column 15"), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_NE(json_error(""), "");
  EXPECT_NE(json_error("{").find("parse error"), std::string::npos);
  EXPECT_NE(json_error(R"({"medium": {"ior": 1e999}})").find("number overflow"), std::string::npos);
}

// What stands inside included files is named by their own names.
TEST(JsonInclude, ErrorsNameTheIncludedFile) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  write_text(folder / "parts/box.json", R"({"medium": {"ior": 0}})");
  EXPECT_EQ(json_error(folder, R"({"include": ["parts/box.json"]})"), "parts/box.json: medium.ior: must be >= 1");
  write_text(folder / "parts/box.json", R"({"include": ["../secret.json"]})");
  EXPECT_EQ(json_error(folder, R"({"include": ["parts/box.json"]})"),
            "parts/box.json: include[0]: \"../secret.json\" leaves the folder of the scene file");
  write_text(folder / "a.json", R"({"include": ["b.json"]})");
  write_text(folder / "b.json", R"({"include": ["a.json"]})");
  EXPECT_EQ(json_error(folder, R"({"include": ["a.json"]})"), "b.json: include[0]: includes itself");
}

// Files are counted before those that they include are read: neither a chain nor a list is longer than 256.
TEST(JsonInclude, FilesAreLimited) {
  const TemporaryFolder folder;
  for (int i = 1; i < 300; ++i)
    write_text(folder / (std::to_string(i) + ".json"), R"({"include": [")" + std::to_string(i + 1) + ".json\"]}");
  write_text(folder / "300.json", "{}");
  EXPECT_EQ(json_error(folder, R"({"include": ["1.json"]})"),  // scene.json and 1 to 255 are 256 files
            "255.json: include[0]: is the 257th file of the scene");
  EXPECT_EQ(json_error(folder, R"({"include": ["46.json"]})"), "");
}

// Cutting a scene short anywhere gives a message, never a crash.
TEST(JsonError, TruncatedScenes) {
  const std::string whole =
      R"({"camera": {"look_from": [0, 1, 4], "look_at": [0, 0, 0]}, "objects": [)" + sphere + "]}";
  const TemporaryFolder folder;
  ASSERT_EQ(json_error(folder, whole), "");
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_NE(json_error(folder, whole.substr(0, length)), "") << length;
}

}  // namespace
}  // namespace candil::test

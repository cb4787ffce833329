/// One material in a small glTF file, for tests of what is read of it.
#pragma once

#include <string>

#include "tests/io/image_samples.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {

inline const std::string png_uri = "data:image/png;base64," + std::string(png_rgba8);

/// One triangle with both uv sets and the material; textures 0 to 3 all show the same image.
inline GltfSample sample_with_material(const std::string& material) {
  GltfSample sample;
  sample.add_triangle(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":1", ",\"material\":0");
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 1, 0, 0, 1});
  sample.materials = {material};
  sample.images = {"{\"uri\":\"" + png_uri + "\"}"};
  sample.textures = {R"({"source":0})", R"({"source":0})", R"({"source":0})", R"({"source":0})"};
  return sample;
}

inline const LoadOptions all_extensions = [] {
  LoadOptions options;
  options.experiments = {"KHR_materials_volume_scatter"};
  return options;
}();

inline Material load_material(const std::string& json) {
  return load_sample(sample_with_material(json), all_extensions).scene.materials.at(0);
}

}  // namespace candil::test

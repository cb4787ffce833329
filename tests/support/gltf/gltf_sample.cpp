#include "tests/support/gltf/gltf_sample.h"

#include <cstdint>

#include "io/error.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {

namespace {

void append_array(std::string& json, const char* name, const std::vector<std::string>& elements) {
  if (elements.empty()) return;
  json += std::string(",\"") + name + "\":[";
  for (std::size_t i = 0; i < elements.size(); ++i) json += (i == 0 ? "" : ",") + elements[i];
  json += "]";
}

void append_u32(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

}  // namespace

int GltfSample::add_view(std::span<const std::byte> bytes, const std::string& members) {
  while (buffer.size() % 4 != 0) buffer.push_back(std::byte{0});
  views.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(buffer.size()) +
                  ",\"byteLength\":" + std::to_string(bytes.size()) + members + "}");
  buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  return static_cast<int>(views.size()) - 1;
}

int GltfSample::add_accessor_to_view(int view, int component_type, const std::string& type, std::size_t count,
                                     const std::string& members) {
  accessors.push_back("{\"bufferView\":" + std::to_string(view) +
                      ",\"componentType\":" + std::to_string(component_type) + ",\"type\":\"" + type +
                      "\",\"count\":" + std::to_string(count) + members + "}");
  return static_cast<int>(accessors.size()) - 1;
}

void GltfSample::add_triangle(const std::string& attributes, const std::string& members) {
  if (accessors.empty()) add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  meshes.push_back("{\"primitives\":[{\"attributes\":{\"POSITION\":0" + attributes + "}" + members + "}]}");
  nodes.push_back("{\"mesh\":" + std::to_string(meshes.size() - 1) + "}");
}

std::string GltfSample::json() const {
  std::string json = R"({"asset":{"version":"2.0"})" + root;
  if (!buffer.empty()) {
    json += ",\"buffers\":[{\"byteLength\":" + std::to_string(buffer.size()) +
            ",\"uri\":\"data:application/octet-stream;base64," + to_base64(buffer) + "\"}]";
  }
  append_array(json, "bufferViews", views);
  append_array(json, "accessors", accessors);
  append_array(json, "meshes", meshes);
  append_array(json, "nodes", nodes);
  append_array(json, "materials", materials);
  append_array(json, "textures", textures);
  append_array(json, "images", images);
  append_array(json, "samplers", samplers);
  append_array(json, "cameras", cameras);
  return json + "}";
}

LoadedScene load_text(const std::string& text, const LoadOptions& options) {
  const TemporaryFolder folder;
  write_text(folder / "model.gltf", text);
  return load_scene(folder / "model.gltf", options);
}

LoadedScene load_sample(const GltfSample& sample, const LoadOptions& options) {
  return load_text(sample.json(), options);
}

std::string load_error(const std::string& text) {
  try {
    load_text(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("model.gltf"));
  }
  return {};
}

std::string load_error(const GltfSample& sample) { return load_error(sample.json()); }

std::string make_glb(const std::string& json, const std::string& binary, int length_error) {
  const auto padded = [](std::string text, char fill) {
    while (text.size() % 4 != 0) text += fill;
    return text;
  };
  std::string chunks;
  const auto append_chunk = [&](std::uint32_t type, const std::string& data) {
    append_u32(chunks, static_cast<std::uint32_t>(data.size()));
    append_u32(chunks, type);
    chunks += data;
  };
  append_chunk(0x4E4F534A, padded(json, ' '));
  if (!binary.empty()) append_chunk(0x004E4942, padded(binary, '\0'));
  std::string glb = "glTF";
  append_u32(glb, 2);
  append_u32(glb, static_cast<std::uint32_t>(static_cast<int>(12 + chunks.size()) + length_error));
  return glb + chunks;
}

std::string to_base64(std::span<const std::byte> bytes) {
  constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      group = group << 8 | (i + b < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + b]) : 0);
    }
    for (std::size_t c = 0; c < 4; ++c) text += i + c > bytes.size() ? '=' : alphabet[group >> (18 - 6 * c) & 63];
  }
  return text;
}

}  // namespace candil::test

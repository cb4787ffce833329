#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/color.h"
#include "io/cube_map.h"
#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/image_file.h"

namespace candil {

namespace {

constexpr const char* extension = "EXT_lights_image_based";
constexpr double largest_intensity = 1e12;
/// Pixels along a face: six of them take 400 MB as they are stored.
constexpr int largest_face = 4096;

/// Stored values as radiance. With alpha a PNG is RGBD: what the colour is divided by. The extension's text does not
/// say that colours are sRGB; the exporters that it names and glTF's other colour images have it so.
Image to_radiance(const TextureImage& texture) {
  Image image(texture.width, texture.height, 3);
  for (std::size_t i = 0; i < image.pixels.size() / 3; ++i) {
    const Vec4 stored = texture.rgba8.empty() ? texture.rgba32[i] : Vec4(texture.rgba8[i]) / 255.0f;
    const float divisor = glm::max(stored.w, 1 / 255.0f);
    for (int c = 0; c < 3; ++c) image.pixels[i * 3 + static_cast<std::size_t>(c)] = srgb_to_linear(stored[c]) / divisor;
  }
  return image;
}

Image read_face(const GltfDocument& document, std::size_t index, std::vector<std::filesystem::path>& files) {
  const GltfImageSource& source = document.images()[index];
  const std::string place = indexed("images", index);
  const auto decode = [&](std::span<const std::byte> encoded) {
    return decode_texture(encoded, source.name.empty() ? place : source.name, document.name(), place);
  };
  const TextureImage texture =
      source.buffer_view >= 0
          ? decode(document.buffer_view(static_cast<std::size_t>(source.buffer_view)))
          : decode(read_reference(document.folder(), source.uri, document.name(), place + ".uri", files));
  if (texture.width != texture.height) document.fail(place, "a face of a cube map must be square");
  if (texture.width > largest_face) {
    document.fail(place, "a face of a cube map must not be larger than " + std::to_string(largest_face) + " pixels");
  }
  return to_radiance(texture);
}

CubeFaces read_faces(const GltfDocument& document, const tinygltf::Value& images, const std::string& place,
                     std::vector<std::filesystem::path>& files) {
  CubeFaces faces;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto index = static_cast<std::size_t>(images.Get(f).GetNumberAsInt());
    faces[f] = read_face(document, index, files);
    if (faces[f].width != faces[0].width) document.fail(place, "the six images must have one size");
  }
  return faces;
}

/// The matrix of `rotation`, a quaternion written x, y, z, w.
Mat3 read_rotation(const tinygltf::Value& light, const std::string& place, Warnings& warnings) {
  const Mat3 identity(1);
  if (!light.Has("rotation")) return identity;
  const tinygltf::Value& value = light.Get("rotation");
  double q[4], sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = value.Get(i).GetNumberAsDouble();
    sum += q[i] * q[i];
  }
  const double length = std::sqrt(sum);
  if (!(length > 1e-6 && length < 1e6)) {
    warnings.add(place + ".rotation", "is no rotation, it is ignored");
    return identity;
  }
  const auto unit = [&](int i) { return static_cast<float>(q[i] / length); };
  return glm::mat3_cast(glm::quat(unit(3), unit(0), unit(1), unit(2)));
}

}  // namespace

std::vector<std::filesystem::path> add_image_light(const GltfDocument& document, const std::string& chosen,
                                                   Scene& scene, Warnings& warnings) {
  std::vector<std::filesystem::path> files;
  const std::optional<std::size_t> scene_index = choose_scene(document, chosen);
  if (!scene_index || *scene_index >= document.model().scenes.size()) return files;
  const tinygltf::ExtensionMap& extensions = document.model().scenes[*scene_index].extensions;
  const auto reference = extensions.find(extension);
  if (reference == extensions.end()) return files;
  const auto index = static_cast<std::size_t>(reference->second.Get("light").GetNumberAsInt());
  const tinygltf::Value& light = document.model().extensions.at(extension).Get("lights").Get(index);
  const std::string place = std::string("extensions.") + extension + "." + indexed("lights", index);

  const tinygltf::Value& images = light.Get("specularImages");
  if (images.ArrayLen() == 0) document.fail(place + ".specularImages", "must not be empty");
  // The further rows are blurred for rasterisers, as are the irradiance coefficients; paths blur by themselves.
  const CubeFaces faces = read_faces(document, images.Get(0), place + ".specularImages[0]", files);
  if (light.Get("specularImageSize").GetNumberAsInt() != faces[0].width) {
    warnings.add(place + ".specularImageSize", "the images are " + std::to_string(faces[0].width) + " pixels wide");
  }
  double intensity = 1;
  if (light.Has("intensity")) intensity = light.Get("intensity").GetNumberAsDouble();
  scene.environment = {};
  scene.environment.tint = Vec3(in_range(intensity, 0, largest_intensity, place + ".intensity", warnings));
  scene.environment.image = to_latitude_longitude(faces, read_rotation(light, place, warnings));
  return files;
}

}  // namespace candil

/// Where the readers of glTF materials find a material's properties. Included by the gltf_material*.cpp files alone.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "io/gltf_internal.h"

namespace tinygltf {
struct Material;
}

namespace candil {

/// Bounds of what has none by its text. A film, an index or a dispersion of a million looks like one of a billion, and
/// its square is still a number.
inline constexpr double any_positive = std::numeric_limits<float>::max(), any_measure = 1e6;

/// The properties of one extension's object. What is not given leaves the value alone, which holds the default.
class GltfProperties {
 public:
  GltfProperties(const tinygltf::Value& object, std::string place, TextureTable& textures, Warnings& warnings)
      : object_(object), place_(std::move(place)), textures_(textures), warnings_(warnings) {}

  bool has(const char* key) const;
  /// Clamped to [low, high], with a warning; likewise each channel of a color.
  void read(const char* key, double low, double high, float& value) const;
  void read(const char* key, double low, double high, Vec3& color) const;
  void read(const char* key, double low, double high, Vec4& color) const;
  void read(const char* key, TextureSlot& slot) const;
  /// A normalTextureInfo.
  void read(const char* key, TextureSlot& slot, float& scale) const;
  void warn(const char* key, const std::string& message) const;

 private:
  void read_channels(const char* key, int count, double low, double high, Vec4& color) const;

  const tinygltf::Value& object_;
  const std::string place_;
  TextureTable& textures_;
  Warnings& warnings_;
};

/// One element of materials[].
struct MaterialSource {
  const tinygltf::Material& material;
  std::string place;  ///< "materials[3]"
  TextureTable& textures;
  Warnings& warnings;

  bool has_extension(const char* name) const;
  std::optional<GltfProperties> extension(const char* name) const;
};

/// All extensions but KHR_materials_emissive_strength, whose factor belongs to the core's emission.
void read_material_extensions(const MaterialSource& source, Material& material);

}  // namespace candil

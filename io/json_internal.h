/// What the parts of the JSON scene loader share. json_load.cpp calls them in order; no other code includes this.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.h"
#include "io/json_document.h"
#include "io/json_node.h"
#include "io/load_scene.h"

namespace candil {

/// The root member `key` of the last file that has one.
std::optional<JsonNode> find_last(const std::vector<JsonFile>& files, std::string_view key);

/// What `reference` (a string) names in the root member `section` of the last file that has that name. Fails with the
/// most similar name where there is none.
JsonNode find_named(const std::vector<JsonFile>& files, std::string_view section, const JsonNode& reference);

/// The file that `reference` (a string) means, inside of the folder of its scene file.
std::filesystem::path referenced_file(const JsonNode& reference);

/// Textures by name; images are decoded and ids of Scene::textures given on first use.
class JsonTextures {
 public:
  JsonTextures(const std::vector<JsonFile>& files, LoadedScene& loaded)
      : files_(files), scene_(loaded.scene), files_read_(loaded.files) {}

  /// A slot that is looked up as sRGB; colours that are stored linear are encoded for it.
  TextureSlot colors(const JsonNode& name);
  /// A slot of values as they are stored, such as roughness.
  TextureSlot data(const JsonNode& name);
  /// A normal map, turned as its image is on the surface. Not for mirrored images.
  TextureSlot normals(const JsonNode& name);
  /// The same, made from heights (io/bump_map.h).
  TextureSlot bumps(const JsonNode& name, float height);
  /// Largest colour of a slot that colors() gave, linear.
  Vec3 largest_color(const TextureSlot& slot);

 private:
  enum class Use { colors, data, normals, bumps };
  TextureSlot slot(const JsonNode& name, Use use, float height);
  TextureImage make_image(const JsonNode& texture, Use use, float height);
  TextureImage decode(const JsonNode& image);

  const std::vector<JsonFile>& files_;
  Scene& scene_;
  std::vector<std::filesystem::path>& files_read_;
  std::map<std::string, std::uint32_t> texture_ids_, image_ids_;
  std::map<std::uint32_t, Vec3> largest_colors_;  // by image
  std::size_t decoded_bytes_ = 0;
};

/// Materials by name or in place; ids of Scene::materials are given on first use.
class JsonMaterials {
 public:
  JsonMaterials(const std::vector<JsonFile>& files, Scene& scene, JsonTextures& textures, float medium_ior)
      : files_(files), scene_(scene), textures_(textures), medium_ior_(medium_ior) {}

  /// The material of an object: its member "material", or a grey one.
  std::uint32_t of_object(const JsonNode& object);
  /// Divides the index of refraction of a material that was made for vacuum by that of the medium.
  void immerse(Material& material) const;

 private:
  std::uint32_t add(const JsonNode& source, const std::string& name);

  const std::vector<JsonFile>& files_;
  Scene& scene_;
  JsonTextures& textures_;
  const float medium_ior_;
  std::map<const void*, std::uint32_t> ids_;  ///< By JsonNode::identity(); null is the default material.
};

/// Steps, the first one applied first.
Affine read_transform(const JsonNode& steps);
/// Where the copies of an object stand: its "transform", once for each of its "instances" if it has any. Fails when one
/// cannot be inverted.
std::vector<Affine> read_placements(const JsonNode& object);
/// Fails when a corner of the bounds, once transformed, is farther than 1e9 m from the origin.
void check_reach(const JsonNode& object, const Bounds& bounds, const Affine& to_world);

/// "bunny" for an object with that name, else its place; as kept_name().
std::string object_name(const JsonNode& object);

/// What the files of geometry have become, so that a file is read once however many objects name it, and what they may
/// still expand to.
class JsonGeometryFiles {
 public:
  struct Ply {
    std::uint32_t object = invalid_id;  ///< Into Scene::objects; invalid_id: nothing to show.
    Bounds bounds;
  };
  struct Gltf {
    std::vector<Instance> instances;  ///< Of objects of the scene; as in the file, not yet placed.
    std::vector<Bounds> bounds;       ///< Of each instance, before its transform.
    std::vector<PunctualLight> lights;
    std::vector<Camera> cameras;
  };

  std::map<std::string, std::uint32_t> ply_meshes;  ///< Into Scene::meshes, by file and options.
  std::map<std::string, Ply> ply;                   ///< By file, options and material.
  std::map<std::string, Gltf> gltf;                 ///< By file and material.

  /// Small files must not fill the memory, or take for ever, by being shown in ever more materials: fails when all that
  /// was charged exceeds 8 GiB.
  void charge(const JsonNode& object, std::size_t bytes);
  /// To be called before a file is read: what it needs at least, its size. Returns that.
  std::size_t charge_file(const JsonNode& object, const std::filesystem::path& path);

 private:
  std::size_t bytes_ = 0;
};

std::size_t geometry_bytes(const Mesh& mesh);

void add_shape(const JsonNode& object, JsonMaterials& materials, Scene& scene);
/// Quads and triangles.
void add_mesh(const JsonNode& object, JsonMaterials& materials, Scene& scene);
void add_ply(const JsonNode& object, JsonMaterials& materials, JsonGeometryFiles& geometry, LoadedScene& loaded);
void add_gltf(const JsonNode& object, JsonMaterials& materials, JsonGeometryFiles& geometry, LoadedScene& loaded);

void add_cameras(const std::vector<JsonFile>& files, Scene& scene);
void add_light(const JsonNode& light, Scene& scene);
Environment read_environment_of(const JsonNode& environment, LoadedScene& loaded);
RenderDefaults read_render_defaults(const std::vector<JsonFile>& files);

/// The whole loader for JSON scenes.
LoadedScene load_json_scene(const std::filesystem::path& path);

}  // namespace candil

/// What the parts of the glTF loader share. gltf_load.cpp calls them in order; no other code includes this.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/scene.h"
#include "io/gltf_accessor.h"
#include "io/gltf_deform.h"
#include "io/gltf_document.h"
#include "io/load_scene.h"

namespace tinygltf {
class Value;
struct Primitive;
struct Texture;
struct TextureInfo;
}  // namespace tinygltf

namespace candil {

/// Collects each warning once. A hostile file cannot make more than a hundred of them.
class Warnings {
 public:
  void add(const std::string& message);
  void add(const std::string& place, const std::string& message) { add(place + ": " + message); }
  std::vector<std::string> take();

 private:
  std::set<std::string> seen_;
  std::vector<std::string> messages_;
  std::size_t dropped_ = 0;
};

/// `value` as a float, clamped to [low, high] with a warning when it lies outside.
float in_range(double value, double low, double high, const std::string& place, Warnings& warnings);

/// "materials[3]".
std::string indexed(const char* array, std::size_t index);

/// The images of a texture in order of preference: the first that can be decoded is shown.
using ImageChoice = std::vector<std::size_t>;

/// Decoded images, for a file that is shown at several times. A scene takes its images from here and brings them back.
class ImageCache {
 public:
  /// Nothing for an image that is not here.
  std::optional<TextureImage> take(const ImageChoice& choice);
  /// `choices`: what the images of the scene that is under way are.
  void note_taken(std::vector<ImageChoice> choices) { taken_ = std::move(choices); }
  void put_back(std::vector<TextureImage> images);

 private:
  std::map<ImageChoice, TextureImage> images_;
  std::vector<ImageChoice> taken_;
};

/// The textures that materials use, and their images. Ids of Scene::textures and Scene::images are given on first use,
/// so that nothing else is decoded.
class TextureTable {
 public:
  /// What `cache` (null: none) has is not decoded again.
  TextureTable(const GltfDocument& document, Scene& scene, Warnings& warnings, ImageCache* cache = nullptr)
      : document_(document), scene_(scene), warnings_(warnings), cache_(cache) {}

  /// The id of textures[index] in Scene::textures, invalid_id (and a warning) if it has no image that candil could
  /// read.
  std::uint32_t texture(int index);

  /// Reads and decodes all images in parallel into Scene::images. Throws InputError for the first bad one. Returns the
  /// files that were read.
  std::vector<std::filesystem::path> decode_images();

 private:
  ImageChoice images_of(const tinygltf::Texture& texture);
  std::uint32_t image(const ImageChoice& choice);
  /// The first image with the same source: exporters list a file once per texture.
  std::size_t first_alike(std::size_t image);
  TextureImage decode(std::size_t index, std::vector<std::filesystem::path>& files) const;
  /// The first image of the choice that can be decoded; `reason` becomes why that is not the very first.
  TextureImage decode_first(const ImageChoice& choice, std::vector<std::filesystem::path>& files,
                            std::string& reason) const;

  const GltfDocument& document_;
  Scene& scene_;
  Warnings& warnings_;
  ImageCache* cache_;
  std::map<int, std::uint32_t> texture_ids_;
  std::map<std::pair<std::string_view, int>, std::size_t> first_images_;
  std::map<ImageChoice, std::uint32_t> image_ids_;
  std::vector<ImageChoice> image_choices_;
};

/// A textureInfo wherever it stands: in the core specification or in an extension.
struct TextureUse {
  int texture = -1, uv_set = 0;
  const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform.
};

/// The slot for a textureInfo at `place`; unused when there is none or it cannot be read (with a warning).
TextureSlot make_texture_slot(const TextureUse& use, const std::string& place, TextureTable& textures,
                              Warnings& warnings);

/// The variant of KHR_materials_variants that is `chosen` by its index or name; nothing for no choice. Throws
/// InputError for a choice that is not there.
std::optional<std::size_t> choose_variant(const GltfDocument& document, const std::string& chosen);

/// The index of the primitive's material in that variant: its own where none is mapped; -1: none. `place` is that of
/// the primitive.
int material_of_variant(const tinygltf::Primitive& primitive, std::optional<std::size_t> variant,
                        const std::string& place, Warnings& warnings);

/// Materials on demand, of one variant; ids of Scene::materials are given on first use.
class MaterialTable {
 public:
  MaterialTable(const GltfDocument& document, Scene& scene, TextureTable& textures, Warnings& warnings,
                std::optional<std::size_t> variant)
      : document_(document), scene_(scene), textures_(textures), warnings_(warnings), variant_(variant) {}

  /// The id of the primitive's material in Scene::materials. `place` is that of the primitive.
  std::uint32_t material(const tinygltf::Primitive& primitive, const std::string& place);

 private:
  /// Of materials[index]; -1 is the specification's default material.
  std::uint32_t material(int index);

  const GltfDocument& document_;
  Scene& scene_;
  TextureTable& textures_;
  Warnings& warnings_;
  const std::optional<std::size_t> variant_;
  std::map<int, std::uint32_t> ids_;
};

/// Primitives that were read, for a file that is shown at several times.
struct GeometryCache {
  struct Entry {
    bool is_read = false;
    TextureSlot tangent_slot;  ///< That its tangents are for; unused: it has none.
    std::optional<Mesh> mesh;  ///< Nothing if the primitive shows nothing.
    VertexSelection selection;
  };
  struct Key {
    std::size_t mesh, primitive;
    bool is_rigid;  ///< Then the mesh is as the scene has it, before it is placed; otherwise as in the file.
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, Entry> primitives;
};

/// meshes[i] as one object: its primitives are appended to Scene::meshes, those of points and lines if they are to have
/// a radius (metres; 0: they have none).
class MeshReader {
 public:
  /// What `cache` (null: none) has is not read again.
  MeshReader(const GltfDocument& document, Scene& scene, MaterialTable& materials, Warnings& warnings,
             float point_radius = 0, GeometryCache* cache = nullptr);

  /// True if the object depends on the linear part of the transform that it will be shown with: points and lines are as
  /// thick in all.
  bool is_thick(std::size_t index) const;

  /// `to_world` is of no account unless is_thick(). Throws InputError for anything in it that cannot be read.
  Object read(std::size_t index, const Deformation& deformation, const Mat3& to_world = Mat3(1.0f));

  /// Of all objects so far.
  ThinCounts thin_counts() const { return thin_counts_; }

 private:
  const GltfDocument& document_;
  Scene& scene_;
  MaterialTable& materials_;
  Warnings& warnings_;
  float point_radius_;
  GeometryCache* cache_;
  ThinCounts thin_counts_;
  std::size_t bytes_left_;  // of geometry, before a file is taken for hostile
};

/// A node of the scene.
struct PlacedNode {
  std::size_t node = 0;
  Affine to_world;
  bool is_visible =
      true;  ///< KHR_node_visibility of it and its parents: meshes and lights are shown, cameras do not care.
};

/// All nodes of the scene that is `chosen` by its index or name; of none, the default scene (else of the first, else of
/// all). Parents first. Throws InputError for a choice that is not there, cycles, nodes with two parents and transforms
/// that overflow.
std::vector<PlacedNode> place_nodes(const GltfDocument& document, const std::string& chosen, Warnings& warnings);

/// The element of an array of the file that a person chose by its index or name; a name goes before an index. Throws
/// InputError, with what there is, for a choice that is not there. `kind` is its name in messages: "scene".
std::size_t find_choice(const GltfDocument& document, const char* kind, const std::vector<std::string>& names,
                        const std::string& choice);

/// The global transform of every node, in the scene or not: joints may be anywhere.
std::vector<Affine> global_transforms(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                                      Warnings& warnings);

/// Reads the meshes that no node in the scene shows, and forgets them: damage is reported wherever it is.
void check_unused_meshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes);

/// scenes[] of that index or name; of an empty choice the default scene, else the first; none if the file has none.
/// Throws InputError as find_choice().
std::optional<std::size_t> choose_scene(const GltfDocument& document, const std::string& chosen);

/// The most instances of EXT_mesh_gpu_instancing in one scene: what fits into 1 GB.
inline constexpr std::size_t most_gpu_instances = std::size_t{1} << 21;

/// EXT_mesh_gpu_instancing: where the copies of nodes[node].mesh stand in the space of the node; without the extension
/// there is one, where the node is. Throws InputError, also for more than `instances_left`, which it counts down.
std::vector<Affine> instance_transforms(const GltfDocument& document, std::size_t node, std::size_t& instances_left);

/// Adds to the scene what each node carries. Points and lines get the radius (metres), if it is not 0.
ThinCounts add_instances(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene,
                         MaterialTable& materials, Warnings& warnings, float point_radius,
                         GeometryCache* cache = nullptr);
void add_cameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene, Warnings& warnings);
void add_lights(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene, LightUnits units,
                Warnings& warnings);

/// EXT_lights_image_based: the light of the scene that is `chosen` as for place_nodes() becomes Scene::environment; a
/// scene may have none. Returns the files that were read. Throws InputError for images that make no cube.
std::vector<std::filesystem::path> add_image_light(const GltfDocument& document, const std::string& chosen,
                                                   Scene& scene, Warnings& warnings);

/// The whole loader for .gltf and .glb.
LoadedScene load_gltf(const std::filesystem::path& path, const LoadOptions& options);

}  // namespace candil

/// A glTF file, parsed and structurally sound, with the bytes that it refers to. What the numbers in it mean is the
/// business of the gltf_*.cpp readers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_buffers.h"
#include "io/gltf_compressed.h"
#include "io/gltf_contents.h"
#include "io/resource.h"

namespace tinygltf {
class Model;
}

namespace candil {

/// Where the encoded bytes of images[i] are: in a buffer view, or behind a URI (empty when there is a view).
struct GltfImageSource {
  std::string name, uri;
  int buffer_view = -1;
};

/// What moves the vertices of a mesh: nodes, and where they stand in the mesh's own space.
struct GltfSkin {
  int inverse_bind_matrices = -1;   ///< Accessor.
  std::vector<std::size_t> joints;  ///< Nodes.
};

struct GltfAnimationSampler {
  int input = 0, output = 0;  ///< Accessors: times, values.
  std::string interpolation;
};

struct GltfAnimationChannel {
  std::size_t sampler = 0;  ///< Of the same animation.
  int node = -1;
  std::string path, pointer;  ///< The pointer of KHR_animation_pointer for the path "pointer".
};

struct GltfAnimation {
  std::string name;
  std::vector<GltfAnimationSampler> samplers;
  std::vector<GltfAnimationChannel> channels;
};

class GltfDocument {
 public:
  /// Reads the file and all its buffers, each once. Throws InputError for anything that is not a structurally sound
  /// glTF 2.x asset (see check_gltf_schema()), and for required extensions that candil does not have, `experiments`
  /// (extensions by name) apart.
  explicit GltfDocument(const std::filesystem::path& path, std::span<const std::string> experiments = {});
  ~GltfDocument();

  /// Properties that are indices are known to be valid, except texture.source inside of extensions that candil does not
  /// know. Holds no buffers, images, skins or animations.
  const tinygltf::Model& model() const { return *model_; }
  /// How messages call the file.
  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// The file itself and those of its buffers.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  const std::vector<GltfImageSource>& images() const { return images_; }
  /// The bytes of bufferViews[index], decompressed; checked to lie in their buffer.
  std::span<const std::byte> buffer_view(std::size_t index) const { return buffers_.views[index]; }
  /// All bytes that came with the scene, the measure of how much geometry it may expand to.
  std::size_t total_bytes() const { return file_.size() + buffers_.total_bytes; }
  /// What Draco streams hold in place of accessors and indices.
  const CompressedPrimitives& compressed_primitives() const { return compressed_primitives_; }
  const std::vector<GltfAnimation>& animations() const { return animations_; }
  const std::vector<GltfSkin>& skins() const { return skins_; }
  const GltfContents& contents() const { return contents_; }

  /// The JSON of everything that an animation can move, checked; an empty object in files without animations.
  const nlohmann::json& movable_json() const { return *movable_; }
  /// Replaces the nodes, cameras, materials, lights and default weights of meshes in model(), those that `parts` has: a
  /// copy of movable_json() or of some of its members, with other values of the same kinds.
  void pose(const nlohmann::json& parts);

  [[noreturn]] void fail(const std::string& place, const std::string& message) const;

 private:
  std::string name_;
  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  Bytes file_;
  GltfBuffers buffers_;
  std::vector<GltfImageSource> images_;
  GltfContents contents_;
  std::vector<GltfSkin> skins_;
  std::vector<GltfAnimation> animations_;
  std::unique_ptr<nlohmann::json> movable_;
  std::unique_ptr<tinygltf::Model> model_;
  CompressedPrimitives compressed_primitives_;
};

}  // namespace candil

#include <algorithm>
#include <utility>

#include "io/error.h"
#include "io/gltf_accessor.h"
#include "io/gltf_animation.h"
#include "io/gltf_extensions.h"
#include "io/gltf_internal.h"
#include "io/scene_sequence.h"

namespace candil {

namespace {

/// One line for everything in the file that the picture will lack.
void report_unsupported(const GltfDocument& document, const LoadOptions& options, LoadedScene& loaded,
                        Warnings& warnings) {
  loaded.contents = document.contents();
  for (const std::string& extension : loaded.contents.extensions_used) {
    if (const auto not_honoured = what_is_not_honoured(extension, options.experiments))
      loaded.not_honoured.push_back(*not_honoured);
    if (is_supported_gltf_extension(extension, options.experiments) || is_harmless_gltf_extension(extension)) continue;
    loaded.extensions_unsupported.push_back(extension);
    warnings.add("extension " + printable(extension) + " is " + why_gltf_extension_is_ignored(extension));
  }
  for (NotHonoured& part : parts_not_honoured(loaded.contents, options.point_radius > 0))
    loaded.not_honoured.push_back(std::move(part));
}

/// What was read of experiments that are off.
void drop_experiments(const LoadOptions& options, Scene& scene) {
  if (is_turned_on("KHR_materials_volume_scatter", options.experiments)) return;
  for (Material& material : scene.materials) {
    if (material.extensions) material.extensions->multiscatter_color = Vec3(0);
  }
}

/// What is kept of a file between two times.
struct GltfCache {
  GeometryCache geometry;
  ImageCache images;
};

enum class Content { all, without_images };

/// The file as it stands. `cache`: null for files that are shown once.
LoadedScene read_document(const GltfDocument& document, const LoadOptions& options, Content content, GltfCache* cache,
                          Warnings& warnings) {
  LoadedScene loaded;
  report_unsupported(document, options, loaded, warnings);
  loaded.animations = list_animations(document);
  TextureTable textures(document, loaded.scene, warnings, cache == nullptr ? nullptr : &cache->images);
  MaterialTable materials(document, loaded.scene, textures, warnings, choose_variant(document, options.variant));
  const std::vector<PlacedNode> nodes = place_nodes(document, options.scene, warnings);
  loaded.thin = add_instances(document, nodes, loaded.scene, materials, warnings, options.point_radius,
                              cache == nullptr ? nullptr : &cache->geometry);
  add_cameras(document, nodes, loaded.scene, warnings);
  add_lights(document, nodes, loaded.scene, options.light_units, warnings);
  // Once is enough to find damage that no picture would show.
  if (cache == nullptr) check_unused_meshes(document, nodes);
  loaded.files = document.files();
  for (std::filesystem::path& file : add_image_light(document, options.scene, loaded.scene, warnings))
    loaded.files.push_back(std::move(file));
  if (content == Content::all) {
    for (std::filesystem::path& file : textures.decode_images()) loaded.files.push_back(std::move(file));
  }
  drop_experiments(options, loaded.scene);
  bake_single_instances(loaded.scene);
  return loaded;
}

}  // namespace

LoadedScene load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
  GltfDocument document(path, options.experiments);
  Warnings warnings;
  if (options.is_animated()) {
    GltfAnimator(document, options.animation, warnings).move(document, options.at.value_or(0));
  }
  LoadedScene loaded = read_document(document, options, Content::all, nullptr, warnings);
  check_accessors(document);
  loaded.warnings = warnings.take();
  return loaded;
}

struct SceneSequence::File {
  File(const std::filesystem::path& path, const LoadOptions& asked)
      : options(asked), document(path, asked.experiments), animator(document, asked.animation, warnings) {
    check_accessors(document);
  }

  LoadedScene read(double seconds, Content content) {
    animator.move(document, seconds);
    return read_document(document, options, content, &cache, warnings);
  }

  LoadOptions options;
  Warnings warnings;  // before the animator, which adds to them
  GltfDocument document;
  GltfAnimator animator;
  GltfCache cache;
  std::optional<Motion> motion;
};

SceneSequence::SceneSequence(const std::filesystem::path& path, const LoadOptions& options) {
  if (!is_gltf_scene(path)) throw InputError(path.string(), "", "has no animations; only glTF files do");
  file_ = std::make_unique<File>(path, options);
}

SceneSequence::~SceneSequence() = default;

LoadedScene SceneSequence::at(double seconds) {
  LoadedScene loaded = file_->read(seconds, Content::all);
  loaded.warnings = std::exchange(file_->warnings, {}).take();
  return loaded;
}

void SceneSequence::recycle(Scene scene) { file_->cache.images.put_back(std::move(scene.images)); }

const SceneSequence::Motion& SceneSequence::motion() {
  if (file_->motion) return *file_->motion;
  constexpr int steps = 16;
  constexpr std::size_t most_points = 100'000;  // of one time
  Motion motion;
  for (int step = 0; step <= steps; ++step) {
    const Scene scene = file_->read(file_->animator.length() * step / steps, Content::without_images).scene;
    motion.has_light = motion.has_light || has_light(scene);
    std::vector<Vec3> points = scene_outline(scene);
    if (points.size() > most_points) {
      const Bounds bounds = scene_bounds(scene);
      points.clear();
      for (int corner = 0; corner < 8; ++corner) points.push_back(bounds.corner(corner));
    }
    motion.outline.insert(motion.outline.end(), points.begin(), points.end());
  }
  return file_->motion.emplace(std::move(motion));
}

}  // namespace candil

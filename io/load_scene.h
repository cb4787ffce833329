/// Reads a scene file of any supported kind; the kind is told by its first bytes and its extension.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene.h"
#include "io/gltf_contents.h"
#include "io/load_options.h"

namespace candil {

/// What a scene file wants of its picture; the command line goes before it. Words are as on the command line.
struct RenderDefaults {
  std::optional<std::array<int, 2>> size;  ///< Width and height, pixels.
  std::optional<std::uint32_t> samples_per_pixel, max_bounces;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> integrator, filter, tonemap;
  std::optional<float> exposure;  ///< Stops.
};

struct AnimationSummary {
  std::string name;
  double seconds = 0;  ///< From 0 to its last key.
};

/// Points and segments of lines in glTF primitives, once per object.
struct ThinCounts {
  std::size_t points = 0, lines = 0;
};

struct LoadedScene {
  Scene scene;                        ///< Baked (bake_single_instances()) and valid: renderers need no further check.
  std::vector<std::string> warnings;  ///< One line each; oddities that do not stop a render.
  GltfContents contents;              ///< Of the file; of a JSON scene, the extensions of its glTF files.
  std::vector<NotHonoured> not_honoured;            ///< Of the contents.
  std::vector<std::string> extensions_unsupported;  ///< Those that were ignored and could change the picture.
  ThinCounts thin;                                  ///< Shown only with LoadOptions::point_radius.
  std::vector<std::filesystem::path> files;         ///< All that were read, for programs that must not replace them.
  std::vector<AnimationSummary> animations;         ///< That the file has.
  RenderDefaults render_defaults;                   ///< Of a JSON scene.
  /// The file says what lights it, be it darkness: a JSON scene with lights, an emitting material or an environment.
  /// Otherwise has_light() may tell.
  bool is_lit = false;
};

/// Whether load_scene() takes the file for glTF, the one format with animations.
bool is_gltf_scene(const std::filesystem::path& path);

/// Loads .gltf, .glb, .ply and .json (a scene as docs/scene-format.md has it, or glTF). Throws InputError when the file
/// cannot be used, or has not what the options choose; PLY and JSON scenes have nothing to choose, other options than
/// the defaults make a warning.
LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace candil

/// The steps of a render, for every command that makes one: prepare what the scene file gives, settle every option,
/// render.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/camera_choice.h"
#include "apps/command_options.h"
#include "apps/statistics.h"
#include "io/load_scene.h"
#include "io/scene_sequence.h"

namespace candil {

/// Everything that is made from the scene file before the first ray; the parts refer to the scene, which stays where it
/// is.
struct PreparedScene {
  Scene scene;
  std::vector<std::filesystem::path> files;  ///< That were read.
  std::vector<std::string> warnings;         ///< One line each.
  RenderDefaults defaults;
  std::vector<Vec3> outline;  ///< That an automatic camera frames; empty: the scene's.
  std::unique_ptr<Accelerator> accelerator;
  std::unique_ptr<LightSampler> lights;
  std::unique_ptr<BsdfTables> tables;
  RenderTimes times;
};

/// Works on all threads of the arena that it is called in. Throws InputError.
std::unique_ptr<PreparedScene> prepare_scene(const RenderOptions& options);

/// The same for options.load.at, from a file that is open already. `previous` (null: none) was prepared from it with
/// the same options for another time; what is as it was then is taken over.
std::unique_ptr<PreparedScene> prepare_frame(const RenderOptions& options, SceneSequence& sequence,
                                             std::unique_ptr<PreparedScene> previous);

/// A render with every option settled.
struct RenderPlan {
  RenderOptions options;
  CameraChoice camera;
  RenderSettings settings;  ///< Those of the options, with the size and what follows from other options.
};

/// Throws UsageError or InputError.
RenderPlan plan_render(const PreparedScene& prepared, const RenderOptions& asked);

/// render() of that plan.
RenderResult render_scene(const PreparedScene& prepared, const RenderPlan& plan,
                          const std::function<void(const RenderProgress&)>& on_progress = {},
                          const std::atomic<bool>* stop = nullptr);

/// For the header of files. Only what decides the pixels: the same command writes the same file, byte for byte.
ImageMetadata describe_render(const RenderPlan& plan, std::uint32_t samples);

}  // namespace candil

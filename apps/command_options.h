/// What the command line asks for.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/aov_outputs.h"
#include "apps/camera_choice.h"
#include "apps/environment_choice.h"
#include "apps/frame_names.h"
#include "apps/outputs.h"
#include "integrators/render.h"
#include "io/load_options.h"

namespace candil {

/// `candil render`.
struct RenderOptions {
  std::filesystem::path scene;
  LoadOptions load;
  std::vector<std::string> outputs;  ///< As typed; empty: a PNG named after the scene.
  std::optional<ImageSize> size;
  AcceleratorOptions accelerator;
  RenderSettings settings;  ///< Everything but the size, which follows from the camera when it is not given.
  EnvironmentOptions environment;
  CameraOptions camera;
  DisplayOptions display;
  AovOptions aovs;
  std::filesystem::path statistics;  ///< Empty: none.
  std::optional<FrameRange> frames;  ///< None: a still.
  double frames_per_second = 24;
  bool is_quiet = false;
  /// Options that were on the command line ("--spp"): they go before what the scene file wants.
  std::set<std::string> given;
};

/// `candil fidelity`.
struct FidelityOptions {
  std::string scenario;        ///< A file, or the JSON itself.
  std::filesystem::path base;  ///< What its paths are relative to; empty: see read_scenario().
  double pixel_ratio = 2;      ///< Pixels for each of the scenario's dimensions, along each side.
  RenderOptions render;        ///< What the command line says goes before the scenario.
};

/// `candil tonemap`.
struct TonemapOptions {
  std::filesystem::path input;
  std::vector<std::string> outputs;  ///< As typed; empty: a PNG named after the input.
  DisplayOptions display;            ///< Alpha is written where the input has it, whatever `is_transparent` says.
  bool is_quiet = false;
};

/// `candil info`.
struct InfoOptions {
  std::filesystem::path scene;
  LoadOptions load;
  bool is_json = false;
};

/// `candil bench`.
struct BenchOptions {
  struct Accelerator {
    std::string name;  ///< As typed.
    AcceleratorOptions options;
  };

  std::vector<std::filesystem::path> scenes;
  LoadOptions load;                       ///< The same for all of them.
  std::vector<Accelerator> accelerators;  ///< At least one; the others are compared with it.
  std::vector<int> threads;               ///< Empty: one, and all that the machine has.
  ImageSize size{512, 512};
  std::uint32_t samples_per_pixel = 4;
  int repetitions = 5;
  std::size_t recording_bytes = std::size_t{256} << 20;
  double longest_replay_seconds = 2;
  std::filesystem::path json;  ///< Empty: none; "-": standard output, instead of the tables.
  std::filesystem::path plot;  ///< .svg or .png; empty: none.
  bool is_quiet = false;
};

/// `candil check`.
struct CheckOptions {
  std::filesystem::path suite;
  std::vector<std::string> filters;  ///< Names (with * for any text) and tags; empty: all tests.
  int shard = 1, shards = 1;         ///< Which part of the tests, from 1.
  int jobs = 0;                      ///< Tests at a time; 0: as many as processors.
  int threads = 0;                   ///< Of each test; 0: what is left of the processors.
  std::optional<std::uint64_t> seed;
  std::optional<AcceleratorOptions> accelerator;
  std::string accelerator_word;  ///< As typed.
  std::filesystem::path output = "candil-check";
  std::filesystem::path junit;  ///< Empty: none.
  std::filesystem::path html;   ///< A folder; empty: none.
  bool is_update = false;
  std::vector<std::string> updates;  ///< Names of the tests to update; empty: all.
  bool is_resumed = false;
  bool is_quiet = false;
};

}  // namespace candil

/// Scenarios of the Khronos render fidelity suite: one picture each, as JSON.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/math.h"

namespace candil {

/// With the defaults of the harness (its config-reader.ts) for what the JSON leaves out.
struct Scenario {
  std::filesystem::path model;
  std::filesystem::path lighting;        ///< A latitude-longitude image; empty: not said.
  std::filesystem::path output;          ///< Empty: not said.
  double width = 768, height = 768;      ///< Of the page, before the pixel ratio.
  glm::dvec3 target{0.0};                ///< Metres.
  double theta = 0;                      ///< Degrees about +Y: 0 looks from +Z, positive turns the eye to +X.
  double phi = 90;                       ///< Degrees from +Y down to the eye: 90 is level.
  double radius = 1;                     ///< Metres from the target to the eye; 0: the eye is in it, and looks as ever.
  double vertical_fov = 45;              ///< Degrees.
  bool has_skybox = false;               ///< The lighting is seen behind the model; otherwise the picture has alpha.
  std::optional<std::uint32_t> samples;  ///< For each pixel.

  glm::dvec3 eye() const;
  /// A point that the eye looks at.
  glm::dvec3 aim() const;
};

/// `text` is JSON, or a file of it. Model and lighting come out as paths from the current folder: relative ones are
/// taken from `base`; if that is empty, from the folder of the file, or for bare JSON from test/renderers/candil, where
/// pages of the harness would be. Throws InputError.
Scenario read_scenario(const std::string& text, const std::filesystem::path& base);

}  // namespace candil

#include "core/tonemap.h"

#include <array>

#include "core/color.h"

namespace candil {
namespace {

constexpr std::array<std::string_view, 3> names = {"neutral", "clamp", "none"};

/// Khronos PBR Neutral Tone Mapper (Khronos Group 2024, "PBR Neutral Specification"): keeps base colours as they are
/// below the start of compression and takes highlights towards white.
Vec3 neutral(Vec3 color) {
  constexpr float fresnel = 0.04f;  // what a dielectric of index 1.5 adds to its base colour at normal incidence
  constexpr float start_compression = 0.8f - fresnel;
  constexpr float desaturation = 0.15f;
  constexpr float headroom = 1 - start_compression;

  const float low = min_component(color);
  color -= low < 2 * fresnel ? low - low * low / (4 * fresnel) : fresnel;
  const float peak = max_component(color);
  if (peak < start_compression) return color;

  const float new_peak = 1 - headroom * headroom / (peak + headroom - start_compression);
  color *= new_peak / peak;
  const float whiteness = 1 - 1 / (desaturation * (peak - new_peak) + 1);
  return glm::mix(color, Vec3(new_peak), whiteness);
}

}  // namespace

std::optional<Tonemap> tonemap_from_name(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<Tonemap>(i);
  return std::nullopt;
}

std::vector<std::string> tonemap_names() { return {names.begin(), names.end()}; }

Vec3 apply_tonemap(Tonemap operator_kind, Vec3 color) {
  switch (operator_kind) {
    // Defined for light, which is neither negative nor infinite.
    case Tonemap::neutral:
      return neutral(glm::clamp(color, Vec3(0.0f), Vec3(std::numeric_limits<float>::max())));
    case Tonemap::clamp:
      return glm::clamp(color, Vec3(0.0f), Vec3(1.0f));
    case Tonemap::none:
      return color;
  }
  return color;
}

Image to_display(const Image& linear, float exposure_stops, Tonemap operator_kind) {
  const float scale = std::exp2(exposure_stops);
  Image display = linear;
  const std::size_t channels = static_cast<std::size_t>(linear.channels);
  for (std::size_t i = 0; i + channels <= display.pixels.size(); i += channels) {
    float* const pixel = &display.pixels[i];
    const float alpha = channels == 4 ? pixel[3] : 1.0f;
    const float factor = alpha > 0 ? scale / alpha : scale;
    const Vec3 color = apply_tonemap(operator_kind, factor * Vec3(pixel[0], pixel[1], pixel[2]));
    for (int k = 0; k < 3; ++k) pixel[k] = glm::clamp(linear_to_srgb(color[k]), 0.0f, 1.0f);
  }
  return display;
}

}  // namespace candil

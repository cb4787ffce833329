#include "core/tonemap.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "core/color.h"
#include "core/tonemap_curves.h"
#include "core/tonemap_reinhard.h"
#include "core/tonemap_statistics.h"

namespace candil {
namespace {

constexpr TonemapParameter white = {
    "white", "the value that becomes white", &Tonemap::white, 1, 1e-6, 1e12,
};

constexpr TonemapParameter display_gamma = {
    "gamma", "the exponent is 1 / gamma", &Tonemap::gamma, 2.2, 0.1, 10,
};

constexpr TonemapParameter share(double initial) {
  return {"share", "of the largest value: becomes white", &Tonemap::share, initial, 1e-6, 1};
}

constexpr std::array agx_parameters = {
    TonemapParameter{"power", "exponent of the look, above 1 for more contrast", &Tonemap::power, 1, 0.1, 10},
    TonemapParameter{"saturation", "of the look", &Tonemap::saturation, 1, 0, 4},
};
constexpr std::array reinhard02_parameters = {
    TonemapParameter{"key", "where the log-average luminance goes", &Tonemap::key, 0.18, 1e-6, 1e3},
    TonemapParameter{"white", "least scaled luminance that is white, 0 for the largest", &Tonemap::white, 0, 0, 1e12},
};
constexpr std::array reinhard05_parameters = {
    TonemapParameter{"intensity", "larger is brighter", &Tonemap::intensity, 0, -8, 8},
    TonemapParameter{"contrast", "0 to choose it by the image", &Tonemap::contrast, 0, 0, 1},
    TonemapParameter{"light", "adaptation to each pixel (1) or to the image (0)", &Tonemap::light, 1, 0, 1},
    TonemapParameter{"color", "adaptation of each channel (1) or to luminance (0)", &Tonemap::color, 0, 0, 1},
};
constexpr std::array clamp_parameters = {white};
constexpr std::array equalize_clamp_parameters = {share(0.78)};
constexpr std::array gamma_parameters = {display_gamma, white};
constexpr std::array clamp_gamma_parameters = {share(0.86), display_gamma};

struct Description {
  TonemapKind kind;
  std::string_view name, summary;
  std::span<const TonemapParameter> parameters = {};
};

constexpr std::array<Description, 11> descriptions = {{
    {TonemapKind::neutral, "neutral", "Khronos PBR Neutral: base colours stay as they are"},
    {TonemapKind::aces, "aces", "film-like, the ACES fit by Stephen Hill"},
    {TonemapKind::agx, "agx", "film-like, AgX in Benjamin Wrensch's minimal form", agx_parameters},
    {TonemapKind::reinhard02, "reinhard02", "photographic, exposed for the average", reinhard02_parameters},
    {TonemapKind::reinhard05, "reinhard05", "photoreceptors that adapt (Reinhard, Devlin)", reinhard05_parameters},
    {TonemapKind::clamp, "clamp", "cut what is brighter than white", clamp_parameters},
    {TonemapKind::equalize, "equalize", "the largest value of the image becomes white"},
    {TonemapKind::equalize_clamp, "equalize-clamp", "a share of the largest value becomes white",
     equalize_clamp_parameters},
    {TonemapKind::gamma, "gamma", "a power curve in place of the sRGB curve", gamma_parameters},
    {TonemapKind::clamp_gamma, "clamp-gamma", "equalize-clamp, then a power curve in place of the sRGB curve",
     clamp_gamma_parameters},
    {TonemapKind::none, "none", "nothing but the sRGB curve"},
}};

const Description& describe(TonemapKind kind) { return descriptions[static_cast<std::size_t>(kind)]; }

bool measures_image(TonemapKind kind) {
  return kind == TonemapKind::reinhard02 || kind == TonemapKind::reinhard05 || kind == TonemapKind::equalize ||
         kind == TonemapKind::equalize_clamp || kind == TonemapKind::clamp_gamma;
}

bool has_own_curve(TonemapKind kind) {
  return kind == TonemapKind::agx || kind == TonemapKind::gamma || kind == TonemapKind::clamp_gamma;
}

/// An operator and what it measured in the image.
struct PreparedTonemap {
  Tonemap tonemap;
  ImageStatistics statistics;
  Photoreceptor receptor;
};

PreparedTonemap prepare(const Tonemap& tonemap, const Image& linear) {
  PreparedTonemap prepared{tonemap, {}, {}};
  if (measures_image(tonemap.kind)) prepared.statistics = measure_image(linear);
  if (tonemap.kind == TonemapKind::reinhard05)
    prepared.receptor = make_photoreceptor(tonemap, prepared.statistics, linear);
  return prepared;
}

/// `color` with `top` as white; black when nothing is brighter than black.
DVec3 relative(DVec3 color, double top) { return top > 0 ? glm::min(color / top, DVec3(1)) : DVec3(0); }

DVec3 power_curve(DVec3 color, double gamma) { return glm::pow(color, DVec3(1 / gamma)); }

/// `color` is finite and not negative.
DVec3 apply(const PreparedTonemap& prepared, DVec3 color) {
  const Tonemap& tonemap = prepared.tonemap;
  const double maximum = prepared.statistics.maximum;
  switch (tonemap.kind) {
    case TonemapKind::neutral:
      return neutral_tonemap(color);
    case TonemapKind::aces:
      return aces_tonemap(color);
    case TonemapKind::agx:
      return agx_tonemap(color, tonemap.power, tonemap.saturation);
    case TonemapKind::reinhard02:
      return reinhard02_tonemap(tonemap, prepared.statistics, color);
    case TonemapKind::reinhard05:
      return reinhard05_tonemap(prepared.receptor, color);
    case TonemapKind::clamp:
      return relative(color, tonemap.white);
    case TonemapKind::equalize:
      return relative(color, maximum);
    case TonemapKind::equalize_clamp:
      return relative(color, tonemap.share * maximum);
    case TonemapKind::gamma:
      return power_curve(relative(color, tonemap.white), tonemap.gamma);
    case TonemapKind::clamp_gamma:
      return power_curve(relative(color, tonemap.share * maximum), tonemap.gamma);
    case TonemapKind::none:
      break;
  }
  return color;
}

}  // namespace

Tonemap make_tonemap(TonemapKind kind) {
  Tonemap tonemap;
  tonemap.kind = kind;
  for (const TonemapParameter& parameter : tonemap_parameters(kind)) tonemap.*parameter.field = parameter.initial;
  return tonemap;
}

std::optional<TonemapKind> tonemap_from_name(std::string_view name) {
  for (const Description& description : descriptions)
    if (description.name == name) return description.kind;
  return std::nullopt;
}

std::string tonemap_name(TonemapKind kind) { return std::string(describe(kind).name); }

std::vector<std::string> tonemap_names() {
  std::vector<std::string> names;
  for (const Description& description : descriptions) names.emplace_back(description.name);
  return names;
}

std::string_view tonemap_summary(TonemapKind kind) { return describe(kind).summary; }

std::span<const TonemapParameter> tonemap_parameters(TonemapKind kind) { return describe(kind).parameters; }

Image to_display(const Image& linear, float exposure_stops, const Tonemap& tonemap) {
  const PreparedTonemap prepared = prepare(tonemap, linear);
  const double exposure = std::exp2(static_cast<double>(exposure_stops));
  Image display = linear;
  tbb::parallel_for(0, linear.height, [&](int y) {
    for (int x = 0; x < linear.width; ++x) {
      float* const pixel = display.pixel(x, y);
      const DVec3 light = exposure * usable_light(straight_color(pixel, linear.channels));
      const DVec3 shown = glm::clamp(apply(prepared, light), DVec3(0), DVec3(1));
      for (int k = 0; k < 3; ++k) {
        const float value = static_cast<float>(shown[k]);
        pixel[k] = has_own_curve(tonemap.kind) ? value : glm::clamp(linear_to_srgb(value), 0.0f, 1.0f);
      }
    }
  });
  return display;
}

}  // namespace candil

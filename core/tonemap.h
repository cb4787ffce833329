/// From scene-linear radiance to what an 8-bit display shows: exposure, then an operator, then the display's curve.
/// With L for a linear value after the exposure and max for the largest one of the image, the operators show
///
///   neutral          Khronos PBR Neutral (Khronos Group 2024)
///   aces             ACES reference rendering and sRGB output, fit by Stephen Hill (2016)
///   agx              AgX by Troy Sobotka, minimal form by Benjamin Wrensch (2023)
///   reinhard02       Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic Tone Reproduction", global
///   reinhard05       Reinhard, Devlin 2005, "Dynamic Range Reduction Inspired by Photoreceptor Physiology"
///   clamp            min(L, white) / white
///   equalize         L / max
///   equalize-clamp   min(L, share max) / (share max)
///   gamma            (min(L, white) / white)^(1 / gamma)
///   clamp-gamma      (min(L, share max) / (share max))^(1 / gamma)
///   none             L
///
/// The last six work on each channel, and but for `none` are those of basic ray tracing courses. The papers and their
/// equations are in tonemap_curves.h and tonemap_reinhard.h.
///
/// Most operators make light for a display to emit in proportion, hence the sRGB curve (IEC 61966-2-1) follows. Not so
/// for gamma and clamp-gamma, whose power curve takes its place, and for agx, which brings its own: their values are
/// stored as they are. So clamp-gamma with gamma = 1 stores bare proportions, which the simplest ray tracers do.
///
/// What an operator measures in the image (tonemap_statistics.h), it measures before the exposure: otherwise those that
/// normalise would cancel it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace candil {

enum class TonemapKind {
  neutral,
  aces,
  agx,
  reinhard02,
  reinhard05,
  clamp,
  equalize,
  equalize_clamp,
  gamma,
  clamp_gamma,
  none
};

/// An operator with its parameters; each operator reads only those that tonemap_parameters() lists for it. Start from
/// make_tonemap(), which knows the defaults.
struct Tonemap {
  TonemapKind kind = TonemapKind::neutral;
  double white = 0;       ///< The value that becomes white; reinhard02: after scaling by the key, 0 for the largest.
  double share = 0;       ///< Of the image's largest value: what becomes white.
  double gamma = 0;       ///< Exponent 1 / gamma.
  double key = 0;         ///< Where the log-average luminance goes ("a" of the paper).
  double intensity = 0;   ///< f of Reinhard and Devlin: larger is brighter.
  double contrast = 0;    ///< m of Reinhard and Devlin; 0 to choose it by the image.
  double light = 0;       ///< a of Reinhard and Devlin: adaptation to the pixel (1) or to the whole image (0).
  double color = 0;       ///< c of Reinhard and Devlin: adaptation of each channel by itself (1) or to luminance (0).
  double power = 0;       ///< AgX: exponent of its look.
  double saturation = 0;  ///< AgX: saturation of its look.
};

/// The operator of that kind with its default parameters.
Tonemap make_tonemap(TonemapKind kind);

/// The operator of that name ("equalize-clamp"); nothing for any other.
std::optional<TonemapKind> tonemap_from_name(std::string_view name);
/// "equalize-clamp".
std::string tonemap_name(TonemapKind kind);
/// All names, in the order of the enumeration, for help texts and messages.
std::vector<std::string> tonemap_names();
/// What an operator does, in one line for help texts.
std::string_view tonemap_summary(TonemapKind kind);

/// A number that an operator takes: Tonemap::*field is in [low, high].
struct TonemapParameter {
  std::string_view name, summary;
  double Tonemap::*field = nullptr;
  double initial = 0, low = 0, high = 0;
};
std::span<const TonemapParameter> tonemap_parameters(TonemapKind kind);

/// RGBA (or RGB) image, linear and premultiplied, to display values in [0, 1]: multiplies by 2^exposure, applies the
/// operator and its curve to colour that is not premultiplied, and leaves alpha as it is, unassociated (as PNG wants).
/// All finite for any input: negative values and NaN count as 0, infinity as the largest float.
Image to_display(const Image& linear, float exposure_stops, const Tonemap& tonemap);

}  // namespace candil

/// From scene-linear radiance to what an 8-bit display shows: exposure, then an operator, then the sRGB curve.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace candil {

enum class Tonemap { neutral, clamp, none };

/// The operator of that name ("neutral", "clamp", "none"); nothing for any other.
std::optional<Tonemap> tonemap_from_name(std::string_view name);
/// All names, in the order of the enumeration, for help texts and messages.
std::vector<std::string> tonemap_names();

/// RGB of one pixel, linear, to display-linear [0, 1].
/// neutral: Khronos PBR Neutral (Khronos specification of 2024). clamp: cut at 0 and 1. none: unchanged.
Vec3 apply_tonemap(Tonemap operator_kind, Vec3 color);

/// RGBA (or RGB) image, linear and premultiplied, to display values in [0, 1]: multiplies by 2^exposure, applies the
/// operator and the sRGB curve to colour that is not premultiplied, and leaves alpha as it is, unassociated (as PNG
/// wants).
Image to_display(const Image& linear, float exposure_stops, Tonemap operator_kind);

}  // namespace candil

/// Operators that look at one colour at a time. Input is linear Rec.709, finite and not negative; all are computed in
/// double precision, in which no square of a float overflows. Values above 1 or (by rounding and by matrices) below 0
/// may come out and are cut by the caller.
#pragma once

#include "core/tonemap_statistics.h"

namespace candil {

/// Khronos PBR Neutral Tone Mapper (Khronos Group 2024, "PBR Neutral Specification"): keeps base colours as they are
/// below the start of compression and takes highlights towards white. Gives display-linear light.
DVec3 neutral_tonemap(DVec3 color);

/// Academy Color Encoding System, reference rendering transform and sRGB output transform together: the rational fit
/// by Stephen Hill (ACES.hlsl of M. Pettineo's BakingLab, 2016), not the simpler one by Narkowicz. Without a factor
/// for exposure: 0.18 becomes about 0.10, as the Academy's own transforms do. Gives display-linear light.
DVec3 aces_tonemap(DVec3 color);

/// AgX (Troy Sobotka, 2022) in the minimal form of Benjamin Wrensch ("Minimal AgX Implementation", iolite-engine.com,
/// 2023): a matrix that mixes the channels, 16.5 stops of logarithm, a polynomial in place of the sigmoid, a look, and
/// the inverse matrix. The look is an ASC CDL power and a saturation, both 1 for the base image; Wrensch's "punchy" is
/// 1.35 and 1.4. Gives values for a display of exponent 2.2 to show as they are.
DVec3 agx_tonemap(DVec3 color, double power, double saturation);

}  // namespace candil

/// Height images as normal maps.
#pragma once

#include "core/scene.h"

namespace candil {

/// The tangent-space normal map (glTF 2.0, section 3.9.3: +X right, +Y up in the image) of a surface whose height is
/// `height` times the red channel as stored. Heights are in units of the image's width, pixels are square. Slopes are
/// central differences; at the edges they wrap as the texture does.
TextureImage normal_map_from_heights(const TextureImage& heights, float height, Wrap wrap);

}  // namespace candil

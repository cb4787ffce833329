/// Arbitrary output variables: what a compositor or a denoiser wants to know of the first surface that a pixel shows.
/// They come from the very camera rays of the picture, so that the filter, the lens and stochastic transparency agree.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/image.h"

namespace candil {

/// All but the ids are means over those samples of the pixel that hit something; 0 where none did. Values beyond
/// +-1e30 (of infinite planes) are cut to that, NaN (from files) is 0: no AOV is ever infinite or not a number.
enum class Aov : std::uint8_t {
  normals,   ///< X, Y, Z: the closure's shading normal, with normal and bump maps, towards the viewer; world space.
  depth,     ///< Z: metres along the viewing axis from the camera's plane, as --focus measures.
  albedo,    ///< R, G, B: see FirstHit::albedo.
  position,  ///< X, Y, Z: metres, world space.
  uv,        ///< U, V: texture coordinates of set 0; 0 for a mesh without.
  material,  ///< id: into Scene::materials, of what a pinhole sees through the middle of the pixel; -1 for nothing.
  object,    ///< id: the same into Scene::instances followed by Scene::shapes.
};

/// "normals", ...; nothing for any other name.
std::optional<Aov> aov_from_name(std::string_view name);
std::string aov_name(Aov aov);
/// All there are, in the order of the enumeration.
std::span<const Aov> all_aovs();
/// The names of its channels.
std::vector<std::string> aov_channels(Aov aov);
/// Ids belong to one ray; a mean of them would be the id of something else.
inline bool is_id(Aov aov) { return aov == Aov::material || aov == Aov::object; }

}  // namespace candil

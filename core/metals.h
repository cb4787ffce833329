/// Complex indices of refraction of metals.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/math.h"

namespace candil {

/// Index eta - i k against vacuum, at one wavelength for each channel of linear Rec.709: 630 nm for red, 532 nm for
/// green and 465 nm for blue (within 2 nm of the primaries of Rec.2020, close to where those of Rec.709 have their
/// weight). Three wavelengths are not a spectrum: colours are right for white light, to the few percent by which
/// measurements of films differ among themselves.
struct Metal {
  std::string_view name;    ///< Lower case, English: "gold".
  std::string_view symbol;  ///< Of the element: "Au".
  Vec3 eta, k;
};

/// All of them, in the order of their names.
std::span<const Metal> metals();

/// By name or by symbol, exactly as written in the table; nothing for any other text.
std::optional<Metal> find_metal(std::string_view name_or_symbol);

}  // namespace candil

// Published measurements at room temperature, linearly interpolated in wavelength to the three of metals.h:
// - gold, silver, copper: Johnson and Christy 1972, "Optical Constants of the Noble Metals", Phys. Rev. B 6, 4370.
// - chromium, cobalt, iron, nickel, palladium, titanium, vanadium: Johnson and Christy 1974, "Optical Constants of
//   Transition Metals", Phys. Rev. B 9, 5056.
// - aluminium: Rakic 1995, "Algorithm for the Determination of Intrinsic Optical Constants of Metal Films", Appl. Opt.
//   34, 4755.
// - platinum, tungsten: Rakic et al. 1998, "Optical Properties of Metallic Films for Vertical-Cavity Optoelectronic
//   Devices", Appl. Opt. 37, 5271 (Brendel-Bormann model fitted to several measurements).
// All of them are tabulated at refractiveindex.info, whose database is in the public domain (CC0).
#include "core/metals.h"

#include <algorithm>
#include <array>

namespace candil {
namespace {

const std::array<Metal, 13> table = {{
    {"aluminium", "Al", {1.430f, 0.939f, 0.686f}, {7.508f, 6.420f, 5.635f}},
    {"chromium", "Cr", {3.145f, 3.034f, 2.456f}, {3.312f, 3.330f, 3.210f}},
    {"cobalt", "Co", {2.209f, 2.001f, 1.789f}, {4.160f, 3.735f, 3.371f}},
    {"copper", "Cu", {0.275f, 1.116f, 1.247f}, {3.373f, 2.596f, 2.456f}},
    {"gold", "Au", {0.188f, 0.544f, 1.332f}, {3.403f, 2.231f, 1.869f}},
    {"iron", "Fe", {2.892f, 2.895f, 2.646f}, {3.065f, 2.918f, 2.805f}},
    {"nickel", "Ni", {1.990f, 1.877f, 1.765f}, {4.094f, 3.495f, 3.048f}},
    {"palladium", "Pd", {1.765f, 1.597f, 1.445f}, {4.275f, 3.743f, 3.351f}},
    {"platinum", "Pt", {2.314f, 2.038f, 1.879f}, {4.160f, 3.612f, 3.223f}},
    {"silver", "Ag", {0.057f, 0.054f, 0.047f}, {4.254f, 3.429f, 2.803f}},
    {"titanium", "Ti", {2.698f, 2.479f, 2.305f}, {3.757f, 3.351f, 3.082f}},
    {"tungsten", "W", {3.635f, 3.469f, 3.337f}, {2.796f, 2.738f, 2.631f}},
    {"vanadium", "V", {3.450f, 3.915f, 3.744f}, {3.042f, 3.125f, 3.404f}},
}};

}  // namespace

std::span<const Metal> metals() { return table; }

std::optional<Metal> find_metal(std::string_view name_or_symbol) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Metal& metal) {
    return metal.name == name_or_symbol || metal.symbol == name_or_symbol;
  });
  return found == table.end() ? std::nullopt : std::optional(*found);
}

}  // namespace candil

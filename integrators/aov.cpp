#include "integrators/aov.h"

#include <algorithm>
#include <array>

namespace candil {
namespace {

constexpr std::array everything = {Aov::normals, Aov::depth,    Aov::albedo, Aov::position,
                                   Aov::uv,      Aov::material, Aov::object};

}  // namespace

std::string aov_name(Aov aov) {
  switch (aov) {
    case Aov::normals:
      return "normals";
    case Aov::depth:
      return "depth";
    case Aov::albedo:
      return "albedo";
    case Aov::position:
      return "position";
    case Aov::uv:
      return "uv";
    case Aov::material:
      return "material";
    case Aov::object:
      return "object";
  }
  return "";
}

std::optional<Aov> aov_from_name(std::string_view name) {
  const auto* const found = std::ranges::find(everything, name, aov_name);
  return found == everything.end() ? std::nullopt : std::optional(*found);
}

std::span<const Aov> all_aovs() { return everything; }

std::vector<std::string> aov_channels(Aov aov) {
  switch (aov) {
    case Aov::normals:
    case Aov::position:
      return {"X", "Y", "Z"};
    case Aov::depth:
      return {"Z"};
    case Aov::albedo:
      return {"R", "G", "B"};
    case Aov::uv:
      return {"U", "V"};
    case Aov::material:
    case Aov::object:
      return {"id"};
  }
  return {};
}

}  // namespace candil

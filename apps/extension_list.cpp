#include "apps/extension_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/gltf_extensions.h"

namespace candil {
namespace {

constexpr const char* legend = R"(
full          as the extension's text has it
partial       approximated, or without some part
ignored       harmless: no still image of the default state shows it; a file may require it
experimental  only with a switch
unsupported   ignored with a warning; a file that requires it is refused
unavailable   likewise, in this build: it lacks a package

Other extensions are unsupported.
)";

std::string to_json_text() {
  nlohmann::ordered_json extensions = nlohmann::ordered_json::array();
  for (const GltfExtension& extension : gltf_extensions())
    extensions.push_back({{"name", extension.name},
                          {"tier", extension.tier_word()},
                          {"is_honoured", extension.is_honoured()},
                          {"remark", extension.explanation()}});
  return nlohmann::ordered_json{{"extensions", extensions}}.dump(2) + "\n";
}

std::string to_text() {
  std::size_t width = 0;
  for (const GltfExtension& extension : gltf_extensions()) width = std::max(width, extension.name.size());
  std::string text;
  for (const GltfExtension& extension : gltf_extensions()) {
    std::string line =
        fmt::format("{:<{}}  {:<12}  {}", extension.name, width, extension.tier_word(), extension.explanation());
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text + legend;
}

}  // namespace

std::string list_extensions(bool is_json) { return is_json ? to_json_text() : to_text(); }

}  // namespace candil

#include "apps/scene_arguments.h"

#include "apps/arguments.h"

namespace candil {

void add_scene_arguments(Arguments& arguments, LoadOptions& options) {
  arguments.group("Scene");
  arguments.add("--scene", "INDEX|NAME", "A scene of the glTF file (default: the one the file names, else the first)",
                [&](const auto&, const auto& text) { options.scene = text; });
  arguments.add("--variant", "INDEX|NAME", "A variant of the materials of the glTF file (default: none)",
                [&](const auto&, const auto& text) { options.variant = text; });
}

}  // namespace candil

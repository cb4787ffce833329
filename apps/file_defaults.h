/// What the scene file wants of its picture, where the command line says nothing.
#pragma once

#include "apps/command_options.h"
#include "io/load_scene.h"

namespace candil {

/// The options with every value settled: from the command line (RenderOptions::given), else from the file, else the
/// program's default. Throws InputError for a word of the file that is not known, with its place: "render.tonemap".
RenderOptions with_file_defaults(const RenderOptions& options, const RenderDefaults& defaults);

}  // namespace candil

/// The arguments that choose among what a glTF file holds, for every command that opens a scene.
#pragma once

#include "io/load_options.h"

namespace candil {

class Arguments;

/// Declares the arguments; parsing fills `options`, which must outlive it.
void add_scene_arguments(Arguments& arguments, LoadOptions& options);

}  // namespace candil

/// The light of a scene that brings none: a photographer's studio, computed, no file.
#pragma once

#include "core/scene.h"

namespace candil {

/// A large soft key box above left, a weaker fill to the right, a strip behind and a bright ceiling in a grey room;
/// neutral colours; a white matt surface that faces the
/// key is just below white on the screen. The camera sees a plain backdrop instead of the boxes.
Environment make_studio_environment();

}  // namespace candil

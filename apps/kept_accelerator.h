/// An acceleration structure that serves the next frame, too, because nothing in it has moved.
#pragma once

#include "apps/render_steps.h"

namespace candil {

/// Whether rays meet the same surfaces in both scenes: meshes, instances, shapes, and which of them need a filter.
bool has_same_geometry(const Scene& a, const Scene& b);

/// Puts `next` into the place of the scene of `prepared`, whose accelerator stays valid. They have the same geometry.
void replace_scene(PreparedScene& prepared, Scene next);

}  // namespace candil

/// The material of surfaces whose file names none.
#pragma once

#include "core/scene.h"

namespace candil {

/// Grey (0.5), ideally diffuse, two-sided.
Material default_material();

}  // namespace candil

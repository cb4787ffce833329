/// Polygons to triangles.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace candil {

/// Triangles over `corners`, by their numbers and with the polygon's own winding; at least 3 corners. Convex polygons
/// become a fan, others lose ears one by one (Meisters 1975), seen along their mean normal (Newell). What that cannot
/// divide, such as an outline that crosses itself, or only in much more than linear time, becomes a fan too: false
/// then.
bool triangulate_polygon(std::span<const Vec3> corners, std::vector<Triangle>& triangles);

}  // namespace candil

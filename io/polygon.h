/// Polygons to triangles.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"

namespace candil {

/// Triangles over `corners`, by their numbers and with the polygon's own winding; at least 3 corners. Convex polygons
/// become a fan, others lose ears one by one (Meisters 1975), seen along their mean normal (Newell). What that cannot
/// divide becomes a fan too, false then: most outlines that cross themselves, and what takes much more than linear time
/// or more tests of a corner against a triangle than are left; those that it took go off `tests_left`.
bool triangulate_polygon(std::span<const Vec3> corners, std::vector<Triangle>& triangles, std::size_t& tests_left);

}  // namespace candil

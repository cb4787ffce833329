/// Where things may stand so that rays can be traced: what every kind of scene file is held to. Embree ends the process
/// for rays that begin, or whose directions are, beyond 1.8e18; squared areas overflow single precision from 1e9 m on.
#pragma once

#include "core/scene.h"

namespace candil {

bool is_finite(const Affine& transform);

/// Finite, and at most 1e9 m from the origin along each axis.
bool is_within_reach(Vec3 position);

/// Whether rays can enter an instance: its transform has an inverse, with elements of at most 1e8, since that is how
/// much it lengthens them.
bool can_be_entered(const Affine& transform);

/// Whether rays of the camera are finite: it is within reach, its axes have lengths and are not parallel, and it shows
/// a width and height of at most 1e9 m, neither more than 1e6 times the other.
bool is_usable(const Camera& camera);

/// A unit vector as the transform turns it; the same where it is scaled to nothing or overflows.
Vec3 turned(const Affine& transform, Vec3 direction);

}  // namespace candil

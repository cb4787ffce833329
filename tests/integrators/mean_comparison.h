/// Whether two integrators have the same expected value.
#pragma once

#include "integrators/render.h"
#include "tests/support/scene_builder.h"

namespace candil::test {

/// Renders the stage, seen from (0.4, 0.6, 2.9) towards the origin, with both integrators and independent numbers, and
/// compares the means over the picture: each channel within 5.5 standard errors (two-sided normal tail: 4e-8), which
/// are below `largest_error` of the mean, so that the test has power.
void expect_same_mean(const Stage& stage, IntegratorKind first, IntegratorKind second, float largest_error);

}  // namespace candil::test

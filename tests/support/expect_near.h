/// Expectations of vectors.
#pragma once

#include <gtest/gtest.h>

#include "core/math.h"

namespace candil::test {

/// Each component within `tolerance`; `what` is told of the one that is not.
inline void expect_near(Vec3 actual, Vec3 expected, float tolerance = 1e-5f, const char* what = "component") {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << what << ' ' << i;
}

}  // namespace candil::test

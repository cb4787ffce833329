#include "core/tonemap_curves.h"

#include <gtest/gtest.h>

#include "tests/core/tonemap_samples.h"

namespace candil {
namespace {

using test::expect_near;

// Rows of the matrices add up to 1 (but for rounding), so grey stays grey, and 1 becomes (1 (1 + 0.0245786) -
// 0.000090537) / (1 (0.983729 + 0.432951) + 0.238081) = 1.024488 / 1.654761 = 0.619115.
TEST(Aces, MapsWhiteAsTheFitDoes) { expect_near(Vec3(aces_tonemap(DVec3(1))), Vec3(0.619115f), 1e-5f); }

// What the fit is made for: the Academy's transforms show a grey card of 0.18 as 0.10 of the display's white.
TEST(Aces, ShowsTheGreyCardAsTheAcademyDoes) { expect_near(Vec3(aces_tonemap(DVec3(0.18))), Vec3(0.10f), 0.01f); }

// Film loses colour where it burns out: a saturated red that is bright enough has green and blue too.
TEST(Aces, BurnsOutToWhite) {
  const DVec3 bright = glm::clamp(aces_tonemap(DVec3(1000, 0, 0)), DVec3(0), DVec3(1));
  EXPECT_GT(bright.y, 0.7);
  EXPECT_GT(bright.z, 0.7);
  const DVec3 dim = aces_tonemap(DVec3(0.1, 0, 0));
  EXPECT_LT(dim.y, 0.2 * dim.x);
}

// Sobotka's curve has its pivot 10 stops above its foot, which is where 0.18 is, and shows it as 0.5; the polynomial is
// within 0.005 of that curve.
TEST(Agx, ShowsTheGreyCardInTheMiddle) { expect_near(Vec3(agx_tonemap(DVec3(0.18), 1, 1)), Vec3(0.5f), 0.005f); }

// log2 of 2^4.026069 is the top of the range: the polynomial at 1 is 15.5 - 40.14 + 31.96 - 6.868 + 0.4298 + 0.1191 -
// 0.00232 = 0.99858. Above it nothing changes.
TEST(Agx, EndsAtTheTopOfItsRange) {
  expect_near(Vec3(agx_tonemap(DVec3(17), 1, 1)), Vec3(0.99858f), 5e-4f);
  expect_near(Vec3(agx_tonemap(DVec3(1e7), 1, 1)), Vec3(0.99858f), 5e-4f);
}

// A power above 1 darkens values below 1; no saturation leaves grey, since the outset keeps grey grey.
TEST(Agx, LookChangesContrastAndSaturation) {
  const DVec3 color(0.4, 0.1, 0.05);
  EXPECT_LT(agx_tonemap(color, 1.35, 1).x, agx_tonemap(color, 1, 1).x);
  const DVec3 grey = agx_tonemap(color, 1, 0);
  EXPECT_NEAR(grey.x, grey.y, 1e-3);
  EXPECT_NEAR(grey.y, grey.z, 1e-3);
  const DVec3 vivid = agx_tonemap(color, 1, 1.4), plain = agx_tonemap(color, 1, 1);
  EXPECT_GT(vivid.x - vivid.z, plain.x - plain.z);
}

}  // namespace
}  // namespace candil

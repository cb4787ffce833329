#include "core/affine.h"

#include <gtest/gtest.h>

#include "tests/support/expect_near.h"

namespace candil {
namespace {

using test::expect_near;

const Affine sheared{Mat3(Vec3(2, 0, 0.5f), Vec3(-1, 1.5f, 0), Vec3(0.25f, 0.5f, 3)), Vec3(4, -5, 6)};
const Affine mirrored{Mat3(Vec3(-1, 0, 0), Vec3(0, 2, 0), Vec3(0.5f, 0, 1)), Vec3(1, 2, 3)};

TEST(Affine, ProductAppliesTheRightFactorFirst) {
  const Vec3 p(0.3f, -2, 7);
  expect_near((sheared * mirrored).point(p), sheared.point(mirrored.point(p)), 1e-4f);
  expect_near((sheared * mirrored).vector(p), sheared.vector(mirrored.vector(p)), 1e-4f);
}

TEST(Affine, TranslationMovesPointsOnly) {
  const Affine moved{Mat3(1), Vec3(1, 2, 3)};
  EXPECT_EQ(moved.point(Vec3(1)), Vec3(2, 3, 4));
  EXPECT_EQ(moved.vector(Vec3(1)), Vec3(1));
}

TEST(Affine, InverseUndoes) {
  const Vec3 p(0.3f, -2, 7);
  for (const Affine& a : {sheared, mirrored}) {
    expect_near(inverse(a).point(a.point(p)), p);
    expect_near(a.vector(inverse(a).vector(p)), p);
  }
}

TEST(Affine, NormalStaysPerpendicularAndOnTheFrontSide) {
  const Vec3 u(1, 2, -1), v(0.5f, -1, 2), normal = glm::cross(u, v);
  for (const Affine& a : {sheared, mirrored}) {
    const Vec3 moved = normal_matrix(a.linear) * normal;
    EXPECT_NEAR(glm::dot(glm::normalize(moved), glm::normalize(a.vector(u))), 0, 1e-6f);
    EXPECT_NEAR(glm::dot(glm::normalize(moved), glm::normalize(a.vector(v))), 0, 1e-6f);
    // A point off the front of the surface is off its front afterwards, mirrored or not.
    EXPECT_GT(glm::dot(moved, a.vector(normal)), 0);
  }
}

TEST(Affine, NormalMatrixOfAFlatteningTransformIsFinite) {
  // Everything squashed onto y = 0, where an inverse would not exist: the normal can only be +-Y.
  const Vec3 moved = normal_matrix(Mat3(Vec3(1, 0, 0), Vec3(0), Vec3(0, 0, 1))) * Vec3(0.6f, 0.8f, 0);
  EXPECT_EQ(moved.x, 0);
  EXPECT_EQ(moved.z, 0);
  EXPECT_NE(moved.y, 0);
}

}  // namespace
}  // namespace candil

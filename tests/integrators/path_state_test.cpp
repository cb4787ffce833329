#include "integrators/path_state.h"

#include <gtest/gtest.h>

namespace candil::test {
namespace {

// A surface whose front faces +z, of a volume or not, inside another volume or not.
TEST(MediumBeyond, IsThatOfTheSideThatLightLeavesTo) {
  Scene scene;
  scene.materials.resize(3);
  constexpr std::uint32_t outer = 0, inner = 1, wall = 2, none = invalid_id;
  for (const std::uint32_t volume : {outer, inner})
    scene.materials[volume].transmission = scene.materials[volume].thickness = 1;
  SurfacePoint surface;
  surface.normal = surface.normal_geometric = Vec3(0, 0, 1);
  const Vec3 front = glm::normalize(Vec3(1, 0, 2)), back = -front;
  surface.material = inner;
  for (const std::uint32_t around : {none, outer}) {
    EXPECT_EQ(medium_beyond(scene, surface, front, front, around), around) << "reflected outside";
    EXPECT_EQ(medium_beyond(scene, surface, front, back, around), inner) << "refracted into it";
  }
  EXPECT_EQ(medium_beyond(scene, surface, back, back, inner), inner) << "reflected inside";
  EXPECT_EQ(medium_beyond(scene, surface, back, back, none), inner) << "the camera was inside";
  EXPECT_EQ(medium_beyond(scene, surface, back, front, inner), none) << "refracted out of it";
  surface.material = wall;
  for (const Vec3 wi : {front, back}) EXPECT_EQ(medium_beyond(scene, surface, front, wi, outer), outer);
}

}  // namespace
}  // namespace candil::test

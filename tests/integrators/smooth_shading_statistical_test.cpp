// Coarse meshes with smooth normals are lit like the smooth bodies that they stand for.
#include <gtest/gtest.h>

#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

constexpr int coarse = 8;  // rows: triangles of 22.5 degrees

Material opaque(float metallic, float roughness, float specular) {
  Material m;
  m.metallic = metallic;
  m.roughness = roughness;
  m.specular = specular;
  return m;
}

/// Rays along -z in a grid over the unit sphere.
std::vector<Ray> rays_at_sphere(const Stage& stage) {
  std::vector<Ray> rays;
  for (int y = -9; y <= 9; ++y) {
    for (int x = -9; x <= 9; ++x) {
      const Ray ray{Vec3(0.107f * static_cast<float>(x), 0.107f * static_cast<float>(y), 5), Vec3(0, 0, -1)};
      if (stage.accelerator().intersect(ray)) rays.push_back(ray);
    }
  }
  EXPECT_GT(rays.size(), 200u);
  return rays;
}

// A directional light of irradiance E on a diffuse sphere: radiance albedo / pi E max(0, cos) with the cosine of the
// smooth normal. The light comes from behind at an angle, so that the terminator crosses many triangles.
TEST(SmoothShading, TerminatorFollowsTheNormals) {
  SceneBuilder builder;
  builder.add_sphere(Vec3(0), 1, builder.add_material(opaque(0, 1, 0)), coarse);
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.intensity = Vec3(pi);
  sun.direction = -glm::normalize(Vec3(0.8f, 0.5f, -0.2f));
  builder.scene.punctual_lights = {sun};
  const Stage stage(builder.scene);
  int lit = 0, dark = 0, lit_behind_triangle = 0;
  for (const Ray& ray : rays_at_sphere(stage)) {
    const SurfacePoint point = make_surface_point(stage.scene(), *stage.accelerator().intersect(ray));
    const float cosine = -glm::dot(point.normal, sun.direction);
    for (const Integrator integrator : {trace_path, trace_classic}) {
      const Estimate estimate = estimate_radiance(stage, integrator, ray, 64, 1);
      // classic lets 95 of 100 paths live: its 64 samples say 0.95 of the mean on average, with an error of 3 %.
      const float tolerance = integrator == trace_path ? 1e-4f : 0.2f * glm::max(cosine, 0.0f) + 1e-4f;
      EXPECT_NEAR(estimate.mean.x, glm::max(0.0f, cosine), tolerance) << ray.origin.x << " " << ray.origin.y;
    }
    (cosine > 0 ? lit : dark) += 1;
    lit_behind_triangle += cosine > 0 && glm::dot(point.normal_geometric, sun.direction) > 0;
  }
  EXPECT_GT(lit, 50);
  EXPECT_GT(dark, 50);
  EXPECT_GT(lit_behind_triangle, 5) << "nothing that flat triangles would get wrong";
}

// A convex body of a lossless material in light 1 from everywhere shows 1 at every point, outlines included: no light
// is lost between the normals and the triangles. Tables of albedo are good to 1 %.
TEST(SmoothShading, ConvexBodiesInUniformLightShowTheirAlbedo) {
  for (const Material& m : {opaque(0, 1, 0), opaque(1, 0, 1), opaque(1, 0.5f, 1), opaque(0, 0.3f, 1)}) {
    SceneBuilder builder;
    builder.add_sphere(Vec3(0), 1, builder.add_material(m), coarse);
    builder.scene.environment.tint = Vec3(1);
    const Stage stage(builder.scene);
    float sum = 0;
    const std::vector<Ray> rays = rays_at_sphere(stage);
    for (const Ray& ray : rays) {
      const Estimate estimate = estimate_radiance(stage, trace_path, ray, 256);
      EXPECT_NEAR(estimate.mean.x, 1, 0.03f + 6 * estimate.standard_error.x)
          << "metallic " << m.metallic << " roughness " << m.roughness << " at " << ray.origin.x << " " << ray.origin.y;
      sum += estimate.mean.x / static_cast<float>(rays.size());
    }
    EXPECT_NEAR(sum, 1, 0.006f) << "metallic " << m.metallic << " roughness " << m.roughness;
  }
}

}  // namespace
}  // namespace candil::test

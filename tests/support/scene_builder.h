/// Small scenes made in code, and everything a render of them needs.
#pragma once

#include <memory>

#include "integrators/integrator.h"
#include "tests/support/accelerator_cases.h"

namespace candil::test {

/// Collects materials and meshes into a scene; ids are returned in order.
class SceneBuilder {
 public:
  std::uint32_t add_material(const Material& material);
  /// Diffuse, no specular, double-sided.
  std::uint32_t add_diffuse(Vec3 albedo, Vec3 emission = Vec3(0));
  /// An object of one mesh; returns the mesh's id.
  std::uint32_t add_mesh(Mesh mesh, std::uint32_t material);
  /// A parallelogram; its front is the side that cross(edge_u, edge_v) points to. uv runs along the edges.
  std::uint32_t add_quad(Vec3 corner, Vec3 edge_u, Vec3 edge_v, std::uint32_t material);
  /// The six sides of an axis-aligned cube; fronts face inwards or outwards.
  void add_cube(Vec3 center, float half_size, std::uint32_t material, bool is_facing_inwards);
  /// A sphere of latitude and longitude triangles with smooth normals, front outwards.
  std::uint32_t add_sphere(Vec3 center, float radius, std::uint32_t material, int rows = 48);
  /// A sphere, disc or plane; returns its id.
  std::uint32_t add_shape(ShapeKind kind, const Affine& to_world, std::uint32_t material);

  Scene scene;
};

/// The rest of a RenderContext, built from a scene that it keeps.
class Stage {
 public:
  explicit Stage(Scene scene, const AcceleratorChoice& accelerator = {});
  RenderContext context() const { return {scene_, *accelerator_, lights_, tables_}; }
  const Scene& scene() const { return scene_; }
  const Accelerator& accelerator() const { return *accelerator_; }
  const LightSampler& lights() const { return lights_; }

 private:
  Scene scene_;
  std::unique_ptr<Accelerator> accelerator_;
  LightSampler lights_;
  BsdfTables tables_;
};

struct Estimate {
  Vec3 mean{0.0f};
  Vec3 standard_error{0.0f};  ///< From the spread of single samples: an upper bound for stratified ones.
};

/// Mean radiance along one ray over that many samples.
Estimate estimate_radiance(const Stage& stage, Integrator integrator, const Ray& ray, std::uint32_t samples,
                           std::uint32_t max_bounces = 4000);

/// Passes when the estimate is within 6 standard errors of the expected value (two-sided normal tail: 2e-9) and those
/// errors are below 1 % of it, so that the test has power.
void expect_radiance(const Estimate& estimate, Vec3 expected);

}  // namespace candil::test

#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/accelerator_cases.h"

namespace candil::test {

std::uint32_t SceneBuilder::add_material(const Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t SceneBuilder::add_diffuse(Vec3 albedo, Vec3 emission) {
  Material m;
  m.base_color = Vec4(albedo, 1);
  m.metallic = 0;
  m.specular = 0;
  m.emission = emission;
  m.is_double_sided = true;
  return add_material(m);
}

std::uint32_t SceneBuilder::add_mesh(Mesh mesh, std::uint32_t material) {
  mesh.material = material;
  const auto id = static_cast<std::uint32_t>(scene.meshes.size());
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({"", id, 1});
  scene.instances.push_back({"", object, Affine{}, true});
  return id;
}

std::uint32_t SceneBuilder::add_quad(Vec3 corner, Vec3 edge_u, Vec3 edge_v, std::uint32_t material) {
  Mesh mesh;
  mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return add_mesh(std::move(mesh), material);
}

void SceneBuilder::add_cube(Vec3 center, float half_size, std::uint32_t material, bool is_facing_inwards) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      Vec3 outwards(0), u(0), v(0);
      outwards[axis] = side, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = side;  // cross(u, v) = outwards
      if (is_facing_inwards) std::swap(u, v);
      add_quad(center + half_size * (outwards - u - v), 2 * half_size * u, 2 * half_size * v, material);
    }
  }
}

std::uint32_t SceneBuilder::add_sphere(Vec3 center, float radius, std::uint32_t material, int rows) {
  Mesh mesh;
  const int columns = 2 * rows;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const float theta = pi * static_cast<float>(i) / static_cast<float>(rows);
      const float phi = 2 * pi * static_cast<float>(j) / static_cast<float>(columns);
      const Vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n);
    }
  }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(i * (columns + 1) + j); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i > 0) mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i + 1 < rows) mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  }
  return add_mesh(std::move(mesh), material);
}

std::uint32_t SceneBuilder::add_shape(ShapeKind kind, const Affine& to_world, std::uint32_t material) {
  scene.shapes.push_back({"", kind, to_world, material});
  return static_cast<std::uint32_t>(scene.shapes.size() - 1);
}

Stage::Stage(Scene scene, const AcceleratorChoice& accelerator)
    : scene_(std::move(scene)),
      accelerator_(make_accelerator_of(accelerator, scene_)),
      lights_(scene_),
      tables_(scene_) {}

Estimate estimate_radiance(const Stage& stage, Integrator integrator, const Ray& ray, std::uint32_t samples,
                           std::uint32_t max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  RayCounts rays;
  glm::dvec3 sum(0), squares(0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const glm::dvec3 x = integrator(stage.context(), settings, ray, Sampler({1, 2}, i, 3), rays).radiance;
    sum += x, squares += x * x;
  }
  const double n = samples;
  const glm::dvec3 mean = sum / n;
  return {Vec3(mean), Vec3(glm::sqrt(glm::max(squares / n - mean * mean, glm::dvec3(0)) / n))};
}

void expect_radiance(const Estimate& estimate, Vec3 expected) {
  for (int c = 0; c < 3; ++c) {
    // Rounding of float arithmetic on the way, where there is no noise at all.
    EXPECT_NEAR(estimate.mean[c], expected[c], 6 * estimate.standard_error[c] + 1e-4f * expected[c]) << "channel " << c;
    EXPECT_LE(estimate.standard_error[c], 0.01f * expected[c]) << "too noisy to tell, channel " << c;
  }
}

}  // namespace candil::test

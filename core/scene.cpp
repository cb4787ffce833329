#include "core/scene.h"

#include <algorithm>
#include <cmath>

#include "core/shape.h"

namespace candil {
namespace {

void bake(Mesh& mesh, const Affine& to_world) {
  const Mat3 normals = normal_matrix(to_world.linear);
  const bool is_mirrored = glm::determinant(to_world.linear) < 0;
  for (Vec3& p : mesh.positions) p = to_world.point(p);
  for (Vec3& n : mesh.normals) {
    const Vec3 turned = normals * n;
    const float length = glm::length(turned);
    if (length > 0 && length < infinity) n = turned / length;
  }
  for (Vec4& t : mesh.tangents) {
    const Vec3 turned = to_world.vector(Vec3(t));
    const float length = glm::length(turned);
    if (length > 0 && length < infinity) t = Vec4(turned / length, is_mirrored ? -t.w : t.w);
  }
  if (is_mirrored) {
    for (Triangle& t : mesh.triangles) t = {t.x, t.z, t.y};
  }
}

template <typename Function>
void for_each_mesh_of(const Scene& scene, const Instance& instance, const Function& function) {
  const Object& object = scene.objects[instance.object];
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
    function(scene.meshes[m]);
  }
}

/// Steps of a half circle in the outline of a round shape, and how many points that makes at most.
constexpr int outline_steps = 12;
constexpr std::size_t outline_points = 2 * outline_steps * (outline_steps + 1);

/// Points around a sphere or disc, in world space, whose hull holds it and little more.
void add_outline(const Shape& shape, std::vector<Vec3>& points) {
  const bool is_sphere = shape.kind == ShapeKind::sphere;
  constexpr float step = pi / outline_steps;
  // Each point of the sphere is within half a diagonal of a cell of the nearest corner, each of the circle within half
  // a step: that far the hull would stay inside.
  const float radius = 1 / std::cos((is_sphere ? std::sqrt(2.0f) : 1.0f) * step / 2);
  for (int column = 0; column < 2 * outline_steps; ++column) {
    const float angle = step * static_cast<float>(column);
    const Vec2 around = radius * Vec2(std::cos(angle), std::sin(angle));
    for (int row = 0; is_sphere && row <= outline_steps; ++row) {
      const float polar = step * static_cast<float>(row);
      points.push_back(shape.to_world.point(Vec3(std::sin(polar) * around, radius * std::cos(polar))));
    }
    if (!is_sphere) points.push_back(shape.to_world.point(Vec3(around, 0)));
  }
}

}  // namespace

Bounds scene_bounds(const Scene& scene) {
  Bounds bounds;
  for (const Instance& instance : scene.instances) {
    for_each_mesh_of(scene, instance, [&](const Mesh& mesh) {
      for (const Vec3 p : mesh.positions) bounds.add(instance.to_world.point(p));
    });
  }
  for (const Shape& shape : scene.shapes) {
    const Bounds box = shape_bounds(shape);
    if (!box.is_empty()) bounds.add(box.low), bounds.add(box.high);
  }
  return bounds;
}

std::vector<Vec3> scene_outline(const Scene& scene) {
  constexpr std::size_t most = 2'000'000;
  std::size_t count = scene.shapes.size() * outline_points;
  for (const Instance& instance : scene.instances) {
    for_each_mesh_of(scene, instance, [&](const Mesh& mesh) { count += mesh.positions.size(); });
  }
  std::vector<Vec3> points;
  for (const Instance& instance : scene.instances) {
    for_each_mesh_of(scene, instance, [&](const Mesh& mesh) {
      Bounds box;
      for (const Vec3 p : mesh.positions) {
        if (count <= most) points.push_back(instance.to_world.point(p));
        box.add(p);
      }
      for (int i = 0; i < 8 && count > most && !box.is_empty(); ++i) {
        points.push_back(instance.to_world.point(box.corner(i)));
      }
    });
  }
  for (const Shape& shape : scene.shapes) {
    const Bounds box = shape_bounds(shape);
    if (box.is_empty()) continue;
    if (count <= most) add_outline(shape, points);
    for (int i = 0; i < 8 && count > most; ++i) points.push_back(box.corner(i));
  }
  return points;
}

bool has_light(const Scene& scene) {
  if (!scene.punctual_lights.empty() || scene.environment.is_present()) return true;
  bool found = std::any_of(scene.shapes.begin(), scene.shapes.end(), [&](const Shape& shape) {
    return max_component(scene.materials[shape.material].emission) > 1;
  });
  for (const Instance& instance : scene.instances) {
    for_each_mesh_of(scene, instance, [&](const Mesh& mesh) {
      found = found || max_component(scene.materials[mesh.material].emission) > 1;
    });
  }
  return found;
}

std::size_t instanced_triangle_count(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& instance : scene.instances) {
    for_each_mesh_of(scene, instance, [&](const Mesh& mesh) { count += mesh.triangles.size(); });
  }
  return count;
}

void bake_single_instances(Scene& scene) {
  std::vector<std::uint32_t> uses(scene.objects.size());
  for (const Instance& instance : scene.instances) ++uses[instance.object];
  for (Instance& instance : scene.instances) {
    if (uses[instance.object] != 1 || instance.is_world_space) continue;
    const Object& object = scene.objects[instance.object];
    for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
      bake(scene.meshes[m], instance.to_world);
    }
    instance.to_world = Affine{};
    instance.is_world_space = true;
  }
}

}  // namespace candil

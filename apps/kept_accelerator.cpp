#include "apps/kept_accelerator.h"

#include <algorithm>
#include <utility>

#include "materials/alpha.h"

namespace candil {
namespace {

bool is_same(const Affine& a, const Affine& b) { return a.linear == b.linear && a.translation == b.translation; }

bool is_same(const Mesh& a, const Mesh& b) {
  return a.material == b.material && a.positions == b.positions && a.triangles == b.triangles &&
         a.normals == b.normals && a.tangents == b.tangents && a.uvs == b.uvs && a.colors == b.colors;
}

bool is_same(const Object& a, const Object& b) { return a.first_mesh == b.first_mesh && a.mesh_count == b.mesh_count; }

bool is_same(const Instance& a, const Instance& b) {
  return a.object == b.object && a.is_world_space == b.is_world_space && is_same(a.to_world, b.to_world);
}

bool is_same(const Shape& a, const Shape& b) {
  return a.kind == b.kind && a.material == b.material && is_same(a.to_world, b.to_world);
}

template <typename T>
bool are_same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return is_same(x, y); });
}

}  // namespace

bool has_same_geometry(const Scene& a, const Scene& b) {
  const HitFilter filter = alpha_filter();
  const bool has_same_filters = std::equal(
      a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
      [&](const Material& x, const Material& y) { return filter.needs_filter(a, x) == filter.needs_filter(b, y); });
  return has_same_filters && are_same(a.objects, b.objects) && are_same(a.instances, b.instances) &&
         are_same(a.shapes, b.shapes) && are_same(a.meshes, b.meshes);
}

void replace_scene(PreparedScene& prepared, Scene next) {
  // The accelerator looks at the scene where it is, and at its indices and shapes in memory: these stay.
  std::swap(next.meshes, prepared.scene.meshes);
  std::swap(next.objects, prepared.scene.objects);
  std::swap(next.instances, prepared.scene.instances);
  std::swap(next.shapes, prepared.scene.shapes);
  prepared.scene = std::move(next);
}

}  // namespace candil

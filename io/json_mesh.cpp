#include "io/json_internal.h"
#include "io/tangents.h"

namespace candil {
namespace {

/// The report's quadrilateral (section 9.5.2): the fourth corner completes the parallelogram, hence both halves are
/// coplanar. u grows from the upper left to the upper right corner, v to the lower left one; on a rectangle these are
/// the projections of its equations 23 and 24.
Mesh make_quad(const JsonNode& corners) {
  const Vec3 upper_left = corners[0].vec3(), upper_right = corners[1].vec3(), lower_left = corners[2].vec3();
  const Vec3 lower_right = upper_right + (lower_left - upper_left);
  Mesh mesh;
  mesh.positions = {upper_left, upper_right, lower_left, lower_right};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}};
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  return mesh;
}

Mesh make_triangle(const JsonNode& object) {
  Mesh mesh;
  const auto normals = object.find("normals"), uvs = object.find("uvs");
  for (std::size_t i = 0; i < 3; ++i) {
    mesh.positions.push_back(object["vertices"][i].vec3());
    if (normals) mesh.normals.push_back((*normals)[i].direction());
    if (uvs) mesh.uvs[0].push_back((*uvs)[i].vec2());
  }
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Fails for a triangle or quad without area.
void check_area(const JsonNode& place, const Mesh& mesh) {
  const glm::dvec3 first = mesh.positions[1] - mesh.positions[0], second = mesh.positions[2] - mesh.positions[0];
  if (!(glm::length(glm::cross(first, second)) > 1e-6 * glm::length(first) * glm::length(second)))
    place.fail("must not lie on one line");
}

}  // namespace

void add_mesh(const JsonNode& object, JsonMaterials& materials, Scene& scene) {
  const bool is_quad = object["type"].text() == "quad";
  Mesh mesh = is_quad ? make_quad(object["corners"]) : make_triangle(object);
  check_area(object[is_quad ? "corners" : "vertices"], mesh);
  mesh.name = object_name(object);
  mesh.material = materials.of_object(object);
  if (scene.materials[mesh.material].normal_texture.is_used() && !mesh.uvs[0].empty()) generate_tangents(mesh, 0);
  Bounds bounds;
  for (const Vec3 p : mesh.positions) bounds.add(p);
  const auto object_id = static_cast<std::uint32_t>(scene.objects.size());
  for (const Affine& placement : read_placements(object)) {
    check_reach(object, bounds, placement);
    scene.instances.push_back({mesh.name, object_id, placement});
  }
  scene.objects.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), 1});
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace candil

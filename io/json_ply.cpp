#include <algorithm>

#include "io/error.h"
#include "io/json_internal.h"
#include "io/ply.h"
#include "io/tangents.h"

namespace candil {
namespace {

PlyOptions read_options(const JsonNode& object) {
  PlyOptions options;
  const std::string normals = object.text("normals", "file");
  if (normals == "smooth") {
    options.normals = NormalSource::smooth;
    options.crease_angle = object.radians("crease_angle", 180);
  }
  if (normals == "flat") options.normals = NormalSource::flat;
  return options;
}

Mesh load_part(const JsonNode& object, const std::filesystem::path& path, const PlyOptions& options,
               std::vector<std::string>& warnings) {
  std::vector<std::string> own_warnings;
  try {
    Mesh mesh = load_ply(path, options, own_warnings);
    for (const std::string& warning : own_warnings) warnings.push_back(object.place() + ": " + warning);
    return mesh;
  } catch (const InputError& error) {
    object["file"].fail(error.what());
  }
}

/// A copy for another material.
Mesh copy_of(const Mesh& source) {
  Mesh mesh = source;
  mesh.tangents.clear();
  return mesh;
}

JsonGeometryFiles::Ply add_object_of(const JsonNode& object, Mesh mesh, std::uint32_t material, Scene& scene) {
  JsonGeometryFiles::Ply ply;
  if (mesh.triangles.empty()) return ply;
  mesh.name = object_name(object);
  mesh.material = material;
  if (scene.materials[material].normal_texture.is_used() && !mesh.uvs[0].empty()) generate_tangents(mesh, 0);
  for (const Vec3 p : mesh.positions) ply.bounds.add(p);
  ply.object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({mesh.name, static_cast<std::uint32_t>(scene.meshes.size()), 1});
  scene.meshes.push_back(std::move(mesh));
  return ply;
}

}  // namespace

void add_ply(const JsonNode& object, JsonMaterials& materials, JsonGeometryFiles& geometry, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  const std::filesystem::path path = referenced_file(object["file"]);
  const PlyOptions options = read_options(object);
  const std::uint32_t material = materials.of_object(object);
  const std::string mesh_key = std::to_string(static_cast<int>(options.normals)) + " " +
                               std::to_string(options.crease_angle) + " " + path.string();
  const auto [entry, is_new] = geometry.ply.try_emplace(std::to_string(material) + " " + mesh_key);
  if (is_new) {
    const auto known = geometry.ply_meshes.find(mesh_key);
    const bool is_known = known != geometry.ply_meshes.end();
    if (!is_known) loaded.files.push_back(path);
    const std::size_t charged = is_known ? 0 : geometry.charge_file(object, path);
    Mesh mesh = is_known ? copy_of(scene.meshes[known->second]) : load_part(object, path, options, loaded.warnings);
    geometry.charge(object, std::max(geometry_bytes(mesh), charged) - charged);
    entry->second = add_object_of(object, std::move(mesh), material, scene);
    if (entry->second.object != invalid_id)
      geometry.ply_meshes.try_emplace(mesh_key, static_cast<std::uint32_t>(scene.meshes.size() - 1));
  }
  const JsonGeometryFiles::Ply& ply = entry->second;
  const std::string name = object_name(object);
  for (const Affine& placement : read_placements(object)) {
    if (ply.object == invalid_id) continue;
    check_reach(object, ply.bounds, placement);
    scene.instances.push_back({name, ply.object, placement});
  }
}

}  // namespace candil

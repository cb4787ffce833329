#include "io/ply_scene.h"

#include "io/default_material.h"
#include "io/ply.h"
#include "io/smooth_normals.h"

namespace candil {

LoadedScene load_ply_scene(const std::filesystem::path& path) {
  LoadedScene loaded;
  loaded.files = {path};
  Mesh mesh = load_ply(path, {}, loaded.warnings);
  if (mesh.triangles.empty()) return loaded;
  if (mesh.normals.empty()) compute_smooth_normals(mesh, glm::radians(40.0f));
  mesh.name = path.stem().string();
  Material material = default_material();
  if (!mesh.colors.empty()) material.base_color = Vec4(1);
  Scene& scene = loaded.scene;
  scene.materials.push_back(std::move(material));
  scene.objects.push_back({mesh.name, 0, 1});
  scene.instances.push_back({mesh.name, 0, {}});
  scene.meshes.push_back(std::move(mesh));
  bake_single_instances(scene);
  return loaded;
}

}  // namespace candil

#include <algorithm>
#include <iterator>

#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/json_internal.h"
#include "io/tangents.h"

namespace candil {
namespace {

template <typename T>
std::uint32_t count(const std::vector<T>& values) {
  return static_cast<std::uint32_t>(values.size());
}

template <typename T>
void append(std::vector<T>& all, std::vector<T>& some) {
  all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
}

void shift_textures(Material& material, std::uint32_t by) {
  for (TextureSlot* slot :
       {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
        &material.occlusion_texture, &material.emission_texture, &material.specular_texture,
        &material.specular_color_texture, &material.transmission_texture})
    if (slot->is_used()) slot->texture += by;
}

/// Every id of `part` moved behind those of `scene`.
void shift_ids(Scene& part, const Scene& scene) {
  for (Mesh& mesh : part.meshes) mesh.material += count(scene.materials);
  for (Object& object : part.objects) object.first_mesh += count(scene.meshes);
  for (Instance& instance : part.instances) instance.object += count(scene.objects);
  for (Material& material : part.materials) shift_textures(material, count(scene.textures));
  for (Texture& texture : part.textures) texture.image += count(scene.images);
}

void replace_materials(Scene& part, std::uint32_t id, const Material& material) {
  for (Mesh& mesh : part.meshes) {
    mesh.material = id;
    if (material.normal_texture.is_used() && mesh.tangents.empty() && !mesh.uvs[0].empty()) generate_tangents(mesh, 0);
  }
}

Bounds bounds_of(const Scene& part, const Instance& instance) {
  Bounds bounds;
  const Object& object = part.objects[instance.object];
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m)
    for (const Vec3 p : part.meshes[m].positions) bounds.add(instance.to_world.point(p));
  return bounds;
}

std::vector<Instance> placed_instances(const JsonNode& object, const Scene& part,
                                       const std::vector<Affine>& placements) {
  constexpr std::size_t most = std::size_t{1} << 26;  // two short lists must not fill the memory
  if (placements.size() * part.instances.size() > most) object.fail("makes more than 67 million instances");
  std::vector<Instance> instances;
  for (const Instance& instance : part.instances) {
    const Bounds bounds = bounds_of(part, instance);
    for (const Affine& placement : placements) {
      check_reach(object, bounds, placement);
      instances.push_back({instance.name, instance.object, placement * instance.to_world});
    }
  }
  return instances;
}

Vec3 turned(const Affine& placement, Vec3 direction) { return glm::normalize(placement.vector(direction)); }

void add_placed_lights(const Scene& part, const std::vector<Affine>& placements, Scene& scene) {
  for (const Affine& placement : placements)
    for (PunctualLight light : part.punctual_lights) {
      light.position = placement.point(light.position);
      light.direction = turned(placement, light.direction);
      scene.punctual_lights.push_back(std::move(light));
    }
}

LoadedScene load_part(const JsonNode& file) {
  const std::filesystem::path path = referenced_file(file);
  try {
    return load_gltf(path);
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

}  // namespace

void add_gltf(const JsonNode& object, JsonMaterials& materials, LoadedScene& loaded) {
  LoadedScene part = load_part(object["file"]);
  Scene& scene = loaded.scene;
  const std::vector<Affine> placements = read_placements(object);
  part.scene.instances = placed_instances(object, part.scene, placements);
  if (object.boolean("lights", true)) add_placed_lights(part.scene, placements, scene);
  if (object.boolean("cameras", false)) {
    for (Camera& camera : part.scene.cameras) camera.to_world = placements.front() * camera.to_world;
    append(scene.cameras, part.scene.cameras);
  }
  if (object.has("material")) {
    const std::uint32_t id = materials.of_object(object);
    shift_ids(part.scene, scene);
    replace_materials(part.scene, id, scene.materials[id]);
  } else {
    for (Material& material : part.scene.materials) materials.immerse(material);
    shift_ids(part.scene, scene);
    append(scene.materials, part.scene.materials);
    append(scene.textures, part.scene.textures);
    append(scene.images, part.scene.images);
  }
  append(scene.meshes, part.scene.meshes);
  append(scene.objects, part.scene.objects);
  append(scene.instances, part.scene.instances);
  for (const std::string& warning : part.warnings) loaded.warnings.push_back(object.place() + ": " + warning);
  append(loaded.extensions_used, part.extensions_used);
  append(loaded.extensions_unsupported, part.extensions_unsupported);
}

}  // namespace candil

#include <algorithm>
#include <iterator>

#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/json_internal.h"
#include "io/placement.h"
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
  for_each_texture_slot(material, [&](TextureSlot& slot) {
    if (slot.is_used()) slot.texture += by;
  });
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

Bounds bounds_of(const Scene& part, const Object& object) {
  Bounds bounds;
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m)
    for (const Vec3 p : part.meshes[m].positions) bounds.add(p);
  return bounds;
}

std::size_t decoded_bytes(const Scene& part) {
  std::size_t bytes = 0;
  for (const Mesh& mesh : part.meshes) bytes += geometry_bytes(mesh);
  for (const TextureImage& image : part.images) bytes += image.bytes();
  return bytes;
}

LoadedScene load_part(const JsonNode& file, const std::filesystem::path& path) {
  try {
    return load_gltf(path, {});
  } catch (const InputError& error) {
    file.fail(error.what());
  }
}

/// Moves everything of the file into the scene, but for what each object places by itself.
JsonGeometryFiles::Gltf add_file(const JsonNode& object, LoadedScene part, std::optional<std::uint32_t> material,
                                 JsonMaterials& materials, LoadedScene& loaded) {
  Scene& scene = loaded.scene;
  JsonGeometryFiles::Gltf gltf;
  std::vector<Bounds> bounds;
  for (const Object& each : part.scene.objects) bounds.push_back(bounds_of(part.scene, each));
  for (const Instance& instance : part.scene.instances) gltf.bounds.push_back(bounds[instance.object]);
  shift_ids(part.scene, scene);
  if (material) {
    replace_materials(part.scene, *material, scene.materials[*material]);
  } else {
    for (Material& each : part.scene.materials) materials.immerse(each);
    append(scene.materials, part.scene.materials);
    append(scene.textures, part.scene.textures);
    append(scene.images, part.scene.images);
  }
  append(scene.meshes, part.scene.meshes);
  append(scene.objects, part.scene.objects);
  gltf.instances = std::move(part.scene.instances);
  gltf.lights = std::move(part.scene.punctual_lights);
  gltf.cameras = std::move(part.scene.cameras);
  for (const std::string& warning : part.warnings) loaded.warnings.push_back(object.place() + ": " + warning);
  append(loaded.files, part.files);
  append(loaded.contents.extensions_used, part.contents.extensions_used);
  append(loaded.contents.extensions_required, part.contents.extensions_required);
  for (const NotHonoured& each : part.not_honoured) {
    loaded.not_honoured.push_back({object.place() + ": " + each.what, each.reason});
  }
  append(loaded.extensions_unsupported, part.extensions_unsupported);
  return gltf;
}

void add_instances(const JsonNode& object, const JsonGeometryFiles::Gltf& gltf, const std::vector<Affine>& placements,
                   Scene& scene) {
  constexpr std::size_t most = std::size_t{1} << 26;  // two short lists must not fill the memory
  if (scene.instances.size() + placements.size() * gltf.instances.size() > most)
    object.fail("makes more than 67 million instances");
  for (std::size_t i = 0; i < gltf.instances.size(); ++i) {
    const Instance& instance = gltf.instances[i];
    for (const Affine& placement : placements) {
      const Affine to_world = placement * instance.to_world;
      check_reach(object, gltf.bounds[i], to_world);
      scene.instances.push_back({instance.name, instance.object, to_world});
    }
  }
}

void add_lights(const JsonNode& object, const std::vector<PunctualLight>& lights, const std::vector<Affine>& placements,
                Scene& scene) {
  constexpr std::size_t most = std::size_t{1} << 20;
  if (scene.punctual_lights.size() + placements.size() * lights.size() > most)
    object.fail("makes more than a million lights");
  for (const Affine& placement : placements)
    for (PunctualLight light : lights) {
      light.position = placement.point(light.position);
      light.direction = turned(placement, light.direction);
      if (light.kind != PunctualKind::directional && !is_within_reach(light.position))
        object.fail("places a light farther than 1e9 m from the origin");
      scene.punctual_lights.push_back(std::move(light));
    }
}

void add_cameras(const JsonNode& object, const std::vector<Camera>& cameras, const Affine& placement, Scene& scene) {
  constexpr std::size_t most = std::size_t{1} << 16;
  if (scene.cameras.size() + cameras.size() > most) object.fail("makes more than 65536 cameras");
  for (Camera camera : cameras) {
    camera.to_world = placement * camera.to_world;
    if (!is_usable(camera)) object.fail("places a camera too far away, or scales it to nothing");
    scene.cameras.push_back(std::move(camera));
  }
}

}  // namespace

void add_gltf(const JsonNode& object, JsonMaterials& materials, JsonGeometryFiles& geometry, LoadedScene& loaded) {
  const std::filesystem::path path = referenced_file(object["file"]);
  const std::vector<Affine> placements = read_placements(object);
  const std::optional<std::uint32_t> material =
      object.has("material") ? std::optional(materials.of_object(object)) : std::nullopt;
  const std::string key = (material ? std::to_string(*material) : "") + " " + path.string();
  const auto [entry, is_new] = geometry.gltf.try_emplace(key);
  if (is_new) {
    const std::size_t charged = geometry.charge_file(object, path);
    LoadedScene part = load_part(object["file"], path);
    geometry.charge(object, std::max(decoded_bytes(part.scene), charged) - charged);
    entry->second = add_file(object, std::move(part), material, materials, loaded);
  }
  Scene& scene = loaded.scene;
  add_instances(object, entry->second, placements, scene);
  if (object.boolean("lights", true)) add_lights(object, entry->second.lights, placements, scene);
  if (object.boolean("cameras", false)) add_cameras(object, entry->second.cameras, placements.front(), scene);
}

}  // namespace candil

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/placement.h"

namespace candil {

namespace {

Vec3 to_vec3(const std::vector<double>& values, Vec3 fallback) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : fallback;
}

Affine matrix_transform(const std::vector<double>& m, const std::string& place, Warnings& warnings) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    warnings.add(place + ".matrix", "has a last row other than 0 0 0 1, which is ignored");
  }
  return {Mat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), Vec3(m[12], m[13], m[14])};
}

/// Specification, section 3.5.3: translation * rotation * scale, or a matrix.
Affine local_transform(const tinygltf::Node& node, const std::string& place, Warnings& warnings) {
  if (node.matrix.size() == 16) return matrix_transform(node.matrix, place, warnings);
  glm::dquat rotation(1, 0, 0, 0);
  if (node.rotation.size() == 4) {
    rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(std::abs(length - 1) < 1e-2)) warnings.add(place + ".rotation", "is not of unit length, it is normalised");
    rotation = length > 0 ? rotation / length : glm::dquat(1, 0, 0, 0);
  }
  const Vec3 scale = to_vec3(node.scale, Vec3(1));
  Affine transform{Mat3(glm::mat3_cast(rotation)), to_vec3(node.translation, Vec3(0))};
  for (int axis = 0; axis < 3; ++axis) transform.linear[axis] *= scale[axis];
  return transform;
}

bool is_visible(const tinygltf::Node& node) {
  const auto visibility = node.extensions.find("KHR_node_visibility");
  if (visibility == node.extensions.end() || !visibility->second.Has("visible")) return true;
  return visibility->second.Get("visible").Get<bool>();
}

/// The parent of every node, -1 for roots. Throws for nodes with two parents and for cycles: the nodes of a cycle
/// all have a parent, hence no walk down from the roots meets them.
std::vector<int> find_parents(const GltfDocument& document) {
  const std::vector<tinygltf::Node>& nodes = document.model().nodes;
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (std::size_t c = 0; c < nodes[n].children.size(); ++c) {
      int& parent = parents[static_cast<std::size_t>(nodes[n].children[c])];
      if (parent >= 0) {
        document.fail(
            indexed("nodes", n) + "." + indexed("children", c),
            "node " + std::to_string(nodes[n].children[c]) + " already is a child of node " + std::to_string(parent));
      }
      parent = static_cast<int>(n);
    }
  }
  std::vector<bool> is_reached(nodes.size());
  std::vector<int> pending;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (parents[n] < 0) pending.push_back(static_cast<int>(n));
  }
  while (!pending.empty()) {
    const auto n = static_cast<std::size_t>(pending.back());
    pending.pop_back();
    is_reached[n] = true;
    pending.insert(pending.end(), nodes[n].children.begin(), nodes[n].children.end());
  }
  const auto lost = std::find(is_reached.begin(), is_reached.end(), false);
  if (lost != is_reached.end()) {
    document.fail(indexed("nodes", static_cast<std::size_t>(lost - is_reached.begin())),
                  "is its own ancestor: the node hierarchy has a cycle");
  }
  return parents;
}

/// Roots of the scene that is shown, in order.
std::vector<int> find_roots(const GltfDocument& document, const std::vector<int>& parents, const std::string& chosen,
                            Warnings& warnings) {
  const tinygltf::Model& model = document.model();
  std::vector<int> roots;
  const std::optional<std::size_t> scene = choose_scene(document, chosen);
  if (!scene) {
    for (std::size_t n = 0; n < parents.size(); ++n) {
      if (parents[n] < 0) roots.push_back(static_cast<int>(n));
    }
    return roots;
  }
  for (const int node : model.scenes[*scene].nodes) {
    if (parents[static_cast<std::size_t>(node)] >= 0) {
      warnings.add(indexed("scenes", *scene) + ".nodes",
                   "node " + std::to_string(node) + " is not a root; the transforms above it are ignored");
    }
    roots.push_back(node);
  }
  return roots;
}

Bounds object_bounds(const Scene& scene, const Object& object) {
  Bounds bounds;
  for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
    for (const Vec3 p : scene.meshes[m].positions) bounds.add(p);
  }
  return bounds;
}

/// What bends the mesh of the node. `joints` keeps the transforms of each skin; the first one asks for all nodes'.
class DeformationReader {
 public:
  DeformationReader(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Warnings& warnings)
      : document_(document), nodes_(nodes), warnings_(warnings) {}

  Deformation read(const PlacedNode& placed) {
    const tinygltf::Node& node = document_.model().nodes[placed.node];
    const tinygltf::Mesh& mesh = document_.model().meshes[static_cast<std::size_t>(node.mesh)];
    Deformation deformation{morph_weights(node, mesh, indexed("nodes", placed.node), warnings_), nullptr,
                            placed.to_world};
    if (node.skin >= 0) deformation.joints = &joints(static_cast<std::size_t>(node.skin));
    return deformation;
  }

 private:
  const std::vector<Affine>& joints(std::size_t skin) {
    const auto [entry, is_new] = joints_.try_emplace(skin);
    if (!is_new) return entry->second;
    if (to_world_.empty()) to_world_ = global_transforms(document_, nodes_, warnings_);
    return entry->second = joint_transforms(document_, skin, to_world_, warnings_);
  }

  const GltfDocument& document_;
  const std::vector<PlacedNode>& nodes_;
  Warnings& warnings_;
  std::vector<Affine> to_world_;
  std::map<std::size_t, std::vector<Affine>> joints_;
};

std::array<float, 9> elements_of(const Mat3& matrix) {
  std::array<float, 9> elements;
  for (int i = 0; i < 9; ++i) elements[static_cast<std::size_t>(i)] = matrix[i / 3][i % 3];
  return elements;
}

void check_reach(const GltfDocument& document, const Bounds& bounds, const Affine& to_world, std::size_t node) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        to_world.point(Vec3((corner & 1 ? bounds.high : bounds.low).x, (corner & 2 ? bounds.high : bounds.low).y,
                            (corner & 4 ? bounds.high : bounds.low).z));
    if (!is_within_reach(p)) {
      document.fail(indexed("nodes", node), "places its mesh farther than 1e9 m from the origin");
    }
  }
}

}  // namespace

std::optional<std::size_t> choose_scene(const GltfDocument& document, const std::string& chosen) {
  const std::vector<tinygltf::Scene>& scenes = document.model().scenes;
  if (chosen.empty() && scenes.empty()) return {};
  if (chosen.empty()) return static_cast<std::size_t>(std::max(document.model().defaultScene, 0));
  std::vector<std::string> names;
  for (const tinygltf::Scene& scene : scenes) names.push_back(scene.name);
  return find_choice(document, "scene", names, chosen);
}

std::vector<PlacedNode> place_nodes(const GltfDocument& document, const std::string& chosen, Warnings& warnings) {
  const std::vector<tinygltf::Node>& nodes = document.model().nodes;
  const std::vector<int> roots = find_roots(document, find_parents(document), chosen, warnings);
  std::vector<PlacedNode> placed, pending;
  std::vector<bool> is_placed(nodes.size());
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    pending.push_back({static_cast<std::size_t>(*root), Affine{}, true});
  }
  while (!pending.empty()) {
    PlacedNode current = pending.back();
    pending.pop_back();
    const tinygltf::Node& node = nodes[current.node];
    if (is_placed[current.node]) continue;
    is_placed[current.node] = true;
    current.is_visible = current.is_visible && is_visible(node);
    const std::string place = indexed("nodes", current.node);
    current.to_world = current.to_world * local_transform(node, place, warnings);
    if (!is_finite(current.to_world)) document.fail(place, "has a transform that overflows");
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      pending.push_back({static_cast<std::size_t>(*child), current.to_world, current.is_visible});
    }
    placed.push_back(current);
  }
  return placed;
}

std::vector<Affine> global_transforms(const GltfDocument& document, const std::vector<PlacedNode>& placed,
                                      Warnings& warnings) {
  const std::vector<tinygltf::Node>& nodes = document.model().nodes;
  std::vector<Affine> to_world(nodes.size());
  std::vector<bool> is_known(nodes.size());
  for (const PlacedNode& each : placed) {
    to_world[each.node] = each.to_world;
    is_known[each.node] = true;
  }
  const std::vector<int> parents = find_parents(document);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    std::vector<std::size_t> unknown;  // the node and those above it
    for (int up = static_cast<int>(n); up >= 0 && !is_known[static_cast<std::size_t>(up)];) {
      unknown.push_back(static_cast<std::size_t>(up));
      up = parents[static_cast<std::size_t>(up)];
    }
    for (auto node = unknown.rbegin(); node != unknown.rend(); ++node) {
      const int parent = parents[*node];
      const Affine local = local_transform(nodes[*node], indexed("nodes", *node), warnings);
      to_world[*node] = parent < 0 ? local : to_world[static_cast<std::size_t>(parent)] * local;
      is_known[*node] = true;
    }
  }
  return to_world;
}

ThinCounts add_instances(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene,
                         MaterialTable& materials, Warnings& warnings, float point_radius, GeometryCache* cache) {
  const tinygltf::Model& model = document.model();
  MeshReader reader(document, scene, materials, warnings, point_radius, cache);
  DeformationReader deformations(document, nodes, warnings);
  // A mesh, the weights of its morph targets and what its shape depends on of the transform, to Scene::objects. Skins
  // bend it for each node anew.
  std::map<std::tuple<int, std::vector<float>, std::array<float, 9>>, std::uint32_t> objects;
  std::vector<Bounds> bounds;  // of each object
  std::size_t instances_left = most_gpu_instances;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = model.nodes[placed.node];
    if (node.mesh < 0 || !placed.is_visible) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const Deformation deformation = deformations.read(placed);
    const bool is_skinned = deformation.joints != nullptr;
    const std::string place = indexed("nodes", placed.node), name = node.name.empty() ? place : kept_name(node.name);
    // Joints place a skinned mesh, its node does not (specification, section 3.7.3.1), nor do instances.
    const std::vector<Affine> in_node =
        is_skinned ? std::vector<Affine>(1) : instance_transforms(document, placed.node, instances_left);
    for (const Affine& instance : in_node) {
      const Affine to_world = is_skinned ? Affine{} : placed.to_world * instance;
      // What cannot be entered is not shown.
      const Mat3 linear = reader.is_thick(mesh) && can_be_entered(to_world) ? to_world.linear : Mat3(1.0f);
      auto object = static_cast<std::uint32_t>(scene.objects.size());
      if (!is_skinned) {
        object = objects.try_emplace({node.mesh, deformation.weights, elements_of(linear)}, object).first->second;
      }
      if (object == scene.objects.size()) {
        scene.objects.push_back(reader.read(mesh, deformation, linear));
        bounds.push_back(object_bounds(scene, scene.objects.back()));
      }
      if (scene.objects[object].mesh_count == 0) continue;
      check_reach(document, bounds[object], to_world, placed.node);
      if (can_be_entered(to_world)) {
        scene.instances.push_back({name, object, to_world});
      } else {
        warnings.add(place, "is scaled to nothing in some direction; its mesh is not shown");
      }
    }
  }
  return reader.thin_counts();
}

void check_unused_meshes(const GltfDocument& document, const std::vector<PlacedNode>& nodes) {
  const tinygltf::Model& model = document.model();
  std::vector<bool> is_used(model.meshes.size());
  for (const PlacedNode& placed : nodes) {
    const int mesh = model.nodes[placed.node].mesh;
    if (mesh >= 0 && placed.is_visible) is_used[static_cast<std::size_t>(mesh)] = true;
  }
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    if (is_used[m]) continue;
    Scene unused;
    Warnings unheard;
    TextureTable unused_textures(document, unused, unheard);
    MaterialTable unused_materials(document, unused, unused_textures, unheard, {});
    MeshReader(document, unused, unused_materials, unheard).read(m, {});
  }
}

}  // namespace candil

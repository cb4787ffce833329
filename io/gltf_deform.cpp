#include "io/gltf_deform.h"

#include <algorithm>
#include <cmath>

#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/placement.h"

namespace candil {

namespace {

/// Weights may be off by this much without a word: a step of the coarsest component type, for each of a few joints.
constexpr float weight_tolerance = 0.02f;

template <class Vector>
void add_scaled(std::vector<Vector>& values, float weight, const std::vector<Vector>& displacements) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * displacements[i];
}

/// Adds one target; `place` is where it stands.
class Morph {
 public:
  Morph(const PrimitiveSource& source, std::size_t target, Mesh& mesh)
      : source_(source),
        target_(source.primitive.targets[target]),
        place_(source.place + "." + indexed("targets", target)),
        mesh_(mesh) {}

  void add(float weight) {
    if (const int index = attribute("POSITION"); index >= 0) {
      add_scaled(mesh_.positions, weight, vec3("POSITION", index));
    }
    if (const int index = attribute("NORMAL"); index >= 0 && !mesh_.normals.empty()) {
      add_scaled(mesh_.normals, weight, vec3("NORMAL", index));
    }
    if (const int index = attribute("TANGENT"); index >= 0 && !mesh_.tangents.empty()) {
      const std::vector<Vec3> displacements = vec3("TANGENT", index);
      for (std::size_t i = 0; i < displacements.size(); ++i) mesh_.tangents[i] += Vec4(weight * displacements[i], 0);
    }
    for (std::size_t set = 0; set < mesh_.uvs.size(); ++set) {
      const std::string semantic = "TEXCOORD_" + std::to_string(set);
      const int index = attribute(semantic);
      if (index < 0 || mesh_.uvs[set].empty()) continue;
      add_scaled(mesh_.uvs[set], weight, read_vec2(source_.document, index, source_.selection, place(semantic)));
    }
    if (const int index = attribute("COLOR_0"); index >= 0 && !mesh_.colors.empty()) {
      add_scaled(mesh_.colors, weight, read_color(source_.document, index, source_.selection, place("COLOR_0"), 0));
    }
  }

 private:
  int attribute(const std::string& semantic) const {
    const auto found = target_.find(semantic);
    return found == target_.end() ? -1 : found->second;
  }
  std::string place(const std::string& semantic) const { return place_ + "." + semantic; }
  std::vector<Vec3> vec3(const std::string& semantic, int index) const {
    return read_vec3(source_.document, index, source_.selection, place(semantic));
  }

  const PrimitiveSource& source_;
  const std::map<std::string, int>& target_;
  const std::string place_;
  Mesh& mesh_;
};

/// The sum of joint transforms, each times its weight, that moves one vertex.
struct Blend {
  Affine sum{Mat3(0), Vec3(0)};
  float weight = 0;
  std::uint32_t first_joint = 0;  // holds the vertex if none has any weight
};

/// Linear blend skinning, section 3.7.3.3.
class Skinning {
 public:
  Skinning(const PrimitiveSource& source, const std::vector<Affine>& joints, Warnings& warnings)
      : source_(source), joints_(joints), warnings_(warnings) {}

  /// False where the primitive has no joints.
  bool move(Mesh& mesh) {
    std::vector<Blend> blends(mesh.positions.size());
    for (std::size_t set = 0; add_set(set, blends); ++set) has_sets_ = true;
    if (!has_sets_) return false;
    finish(blends);
    apply(blends, mesh);
    return true;
  }

 private:
  int attribute(const std::string& semantic) const {
    const auto found = source_.primitive.attributes.find(semantic);
    return found == source_.primitive.attributes.end() ? -1 : found->second;
  }

  bool add_set(std::size_t set, std::vector<Blend>& blends) {
    const std::string joint_semantic = "JOINTS_" + std::to_string(set);
    const std::string weight_semantic = "WEIGHTS_" + std::to_string(set);
    const int joint_index = attribute(joint_semantic), weight_index = attribute(weight_semantic);
    if (joint_index < 0 && weight_index < 0) return false;
    if (joint_index < 0 || weight_index < 0) {
      warnings_.add(source_.place + ".attributes",
                    (joint_index < 0 ? weight_semantic : joint_semantic) + " has no counterpart, it is ignored");
      return false;
    }
    const std::string joint_place = source_.place + ".attributes." + joint_semantic;
    const std::string weight_place = source_.place + ".attributes." + weight_semantic;
    const std::vector<Vec4> joints = read_vec4(source_.document, joint_index, source_.selection, joint_place);
    const std::vector<Vec4> weights = read_vec4(source_.document, weight_index, source_.selection, weight_place);
    for (std::size_t v = 0; v < blends.size(); ++v) {
      for (int c = 0; c < 4; ++c) {
        if (!(weights[v][c] > 0 && weights[v][c] <= 1e6f)) {
          has_bad_weights_ = has_bad_weights_ || weights[v][c] != 0;
          if (set == 0 && c == 0 && is_joint(joints[v][c])) blends[v].first_joint = std::uint32_t(joints[v][c]);
          continue;
        }
        if (!is_joint(joints[v][c])) fail_joint(joint_place, joint_index, v, joints[v][c]);
        add(joints_[static_cast<std::size_t>(joints[v][c])], weights[v][c], blends[v]);
      }
    }
    if (has_bad_weights_) warnings_.add(weight_place, "has weights that are negative or not finite, 0 is used");
    return true;
  }

  bool is_joint(float value) const {
    return value >= 0 && value < static_cast<float>(joints_.size()) && value == std::floor(value);
  }

  [[noreturn]] void fail_joint(const std::string& place, int accessor, std::size_t vertex, float value) const {
    source_.document.fail(
        place, "accessor " + std::to_string(accessor) + " element " +
                   std::to_string(source_.selection.element(vertex)) + ": there is no joint " +
                   (value == std::floor(value) && std::abs(value) < 1e6f ? std::to_string(static_cast<int>(value))
                                                                         : std::to_string(value).substr(0, 12)) +
                   ", the skin has " + std::to_string(joints_.size()));
  }

  static void add(const Affine& joint, float weight, Blend& blend) {
    blend.sum.linear += weight * joint.linear;
    blend.sum.translation += weight * joint.translation;
    blend.weight += weight;
  }

  /// Makes the weights of each vertex sum to 1.
  void finish(std::vector<Blend>& blends) {
    bool is_off = false;
    for (Blend& blend : blends) {
      is_off = is_off || !(std::abs(blend.weight - 1) <= weight_tolerance);
      if (blend.weight > 0) {
        const float scale = 1 / blend.weight;
        blend.sum.linear *= scale;
        blend.sum.translation *= scale;
      } else {
        blend.sum = joints_[blend.first_joint];
      }
    }
    if (is_off) warnings_.add(source_.place, "has joint weights that do not sum to 1, they are normalised");
  }

  static void apply(const std::vector<Blend>& blends, Mesh& mesh) {
    std::vector<bool> is_mirrored(blends.size());
    for (std::size_t v = 0; v < blends.size(); ++v) {
      const Affine& transform = blends[v].sum;
      is_mirrored[v] = glm::determinant(transform.linear) < 0;
      mesh.positions[v] = transform.point(mesh.positions[v]);
      if (!mesh.normals.empty()) mesh.normals[v] = normal_matrix(transform.linear) * mesh.normals[v];
      if (mesh.tangents.empty()) continue;
      Vec4& tangent = mesh.tangents[v];
      tangent = Vec4(transform.vector(Vec3(tangent)), is_mirrored[v] ? -tangent.w : tangent.w);
    }
    // Mirroring joints keep fronts fronts, as mirroring nodes do.
    for (Triangle& t : mesh.triangles) {
      if (is_mirrored[t.x] && is_mirrored[t.y] && is_mirrored[t.z]) t = {t.x, t.z, t.y};
    }
  }

  const PrimitiveSource& source_;
  const std::vector<Affine>& joints_;
  Warnings& warnings_;
  bool has_sets_ = false, has_bad_weights_ = false;
};

/// As a node would place the mesh, which has no instance to do it.
void place(const Affine& to_world, Mesh& mesh) {
  const bool is_mirrored = glm::determinant(to_world.linear) < 0;
  for (Vec3& p : mesh.positions) p = to_world.point(p);
  for (Vec3& n : mesh.normals) n = normal_matrix(to_world.linear) * n;
  for (Vec4& t : mesh.tangents) t = Vec4(to_world.vector(Vec3(t)), is_mirrored ? -t.w : t.w);
  for (Triangle& t : mesh.triangles) {
    if (is_mirrored) t = {t.x, t.z, t.y};
  }
}

Affine to_affine(const float* m) {
  return {Mat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), Vec3(m[12], m[13], m[14])};
}

}  // namespace

std::vector<float> morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh, const std::string& place,
                                 Warnings& warnings) {
  const std::size_t targets = mesh.primitives.empty() ? 0 : mesh.primitives.front().targets.size();
  const std::vector<double>& source = node.weights.empty() ? mesh.weights : node.weights;
  if (!source.empty() && source.size() != targets) {
    warnings.add(place,
                 "has " + std::to_string(source.size()) + " morph weights for " + std::to_string(targets) + " targets");
  }
  std::vector<float> weights(targets);
  for (std::size_t i = 0; i < std::min(targets, source.size()); ++i) weights[i] = static_cast<float>(source[i]);
  if (std::all_of(weights.begin(), weights.end(), [](float weight) { return weight == 0; })) return {};
  return weights;
}

std::vector<Affine> joint_transforms(const GltfDocument& document, std::size_t index,
                                     const std::vector<Affine>& to_world, Warnings& warnings) {
  const GltfSkin& skin = document.skins()[index];
  const std::string place = indexed("skins", index);
  if (skin.joints.empty()) document.fail(place + ".joints", "must not be empty");
  std::vector<Affine> transforms;
  for (const std::size_t joint : skin.joints) transforms.push_back(to_world[joint]);
  if (skin.inverse_bind_matrices < 0) return transforms;
  const std::string matrices_place = place + ".inverseBindMatrices";
  const AccessorKind kind = accessor_kind(document, skin.inverse_bind_matrices);
  if (kind.type != "MAT4" || !kind.has_floats) document.fail(matrices_place, "must be MAT4 of floats");
  const std::size_t count = accessor_count(document, skin.inverse_bind_matrices);
  if (count < transforms.size()) {
    document.fail(matrices_place,
                  "has " + std::to_string(count) + " matrices for " + std::to_string(transforms.size()) + " joints");
  }
  const std::vector<float> matrices =
      read_floats(document, skin.inverse_bind_matrices, 0, transforms.size(), matrices_place);
  for (std::size_t j = 0; j < transforms.size(); ++j) {
    const float* const m = &matrices[16 * j];
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
      warnings.add(matrices_place, "has a last row other than 0 0 0 1, which is ignored");
    }
    transforms[j] = transforms[j] * to_affine(m);
    if (!is_finite(transforms[j])) {
      document.fail(matrices_place, "element " + std::to_string(j) + " is not finite, or its joint's transform is not");
    }
  }
  return transforms;
}

void check_morph_targets(const PrimitiveSource& source) {
  for (std::size_t t = 0; t < source.primitive.targets.size(); ++t) {
    for (const auto& [semantic, accessor] : source.primitive.targets[t]) {
      const std::size_t count = accessor_count(source.document, accessor);
      if (count == source.selection.accessor_count) continue;
      source.document.fail(source.place + "." + indexed("targets", t) + "." + printable(semantic),
                           "accessor " + std::to_string(accessor) + " has " + std::to_string(count) +
                               " elements, POSITION has " + std::to_string(source.selection.accessor_count));
    }
  }
}

void deform(const PrimitiveSource& source, const Deformation& deformation, Mesh& mesh, Warnings& warnings) {
  const std::size_t targets = std::min(deformation.weights.size(), source.primitive.targets.size());
  for (std::size_t t = 0; t < targets; ++t) {
    if (deformation.weights[t] != 0) Morph(source, t, mesh).add(deformation.weights[t]);
  }
  if (deformation.joints == nullptr) return;
  if (Skinning(source, *deformation.joints, warnings).move(mesh)) return;
  warnings.add(source.place, "has no JOINTS_0 and WEIGHTS_0 for the skin of its node, which is left out");
  place(deformation.node_to_world, mesh);
}

}  // namespace candil

#include "io/gltf_pointer.h"

#include <charconv>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "io/gltf_schema_tables.h"

namespace candil {

namespace {

using gltf_schema::Kind;
using gltf_schema::Rule;
using gltf_schema::Table;
using gltf_schema::tables;
using nlohmann::json;

/// "a/b" of "/a~1b", and so on (RFC 6901). Nothing for what is no pointer.
std::optional<std::vector<std::string>> split_pointer(std::string_view pointer) {
  constexpr std::size_t longest = 1000;
  if (pointer.empty() || pointer.front() != '/' || pointer.size() > longest) return {};
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      steps.emplace_back();
    } else if (pointer[i] == '~' && i + 1 < pointer.size() && (pointer[i + 1] == '0' || pointer[i + 1] == '1')) {
      steps.back() += pointer[++i] == '0' ? '~' : '/';
    } else {
      steps.back() += pointer[i];
    }
  }
  return steps;
}

std::optional<std::size_t> to_index(const std::string& step, std::size_t size) {
  std::size_t index = 0;
  const char* const end = step.data() + step.size();
  const auto [rest, error] = std::from_chars(step.data(), end, index);
  if (error != std::errc() || rest != end || index >= size || (step.size() > 1 && step.front() == '0')) return {};
  return index;
}

const Rule* find_rule(const Table& table, const std::string& property) {
  for (const Rule& rule : table) {
    if (rule.property == property) return &rule;
  }
  return nullptr;
}

/// Parts of a file that may change while it is shown.
bool can_change(const std::string& part) {
  return part == "nodes" || part == "meshes" || part == "materials" || part == "cameras" || part == "extensions";
}

std::size_t count_targets(const json& mesh) {
  const json& primitives = mesh.at("primitives");
  if (primitives.empty() || !primitives.front().contains("targets")) return 0;
  return primitives.front().at("targets").size();
}

/// The mesh whose weights steps[1] of "nodes" or "meshes" has; null if there is none.
const json* find_mesh(const json& root, const std::vector<std::string>& steps) {
  const json& owner = root.at(steps[0]).at(std::stoul(steps[1]));
  if (steps[0] == "meshes") return &owner;
  return owner.contains("mesh") ? &root.at("meshes").at(owner.at("mesh").get<std::size_t>()) : nullptr;
}

std::optional<GltfProperty> find_weights(const json& root, GltfProperty property, std::size_t step) {
  const json* const mesh = find_mesh(root, property.steps);
  const std::size_t targets = mesh == nullptr ? 0 : count_targets(*mesh);
  if (targets == 0) return {};
  if (step + 1 == property.steps.size()) {
    property.kind = GltfProperty::Kind::numbers;
    property.is_weights = true;
    property.components = targets;
    return property;
  }
  if (step + 2 != property.steps.size() || !to_index(property.steps.back(), targets)) return {};
  return property;  // a single weight
}

/// The last step: what can change of it.
std::optional<GltfProperty> find_value(GltfProperty property, const Rule& rule) {
  if (rule.kind == Kind::number) return property;
  if (rule.kind == Kind::boolean && rule.property == "visible") {
    property.kind = GltfProperty::Kind::boolean;
    return property;
  }
  if (rule.kind != Kind::numbers || rule.length < 2 || rule.length > 4) return {};
  property.kind = GltfProperty::Kind::numbers;
  property.components = rule.length;
  property.is_rotation = rule.property == "rotation";
  return property;
}

json& value_at(json& root, const std::vector<std::string>& steps) {
  json* value = &root;
  for (const std::string& step : steps) value = value->is_array() ? &value->at(std::stoul(step)) : &(*value)[step];
  return *value;
}

/// T R S of a matrix without shear; a mirroring one gets a negative scale along x. "The decomposition is ambiguous",
/// says the Asset Object Model, which lets animations move parts of it all the same.
void decompose_matrix(json& node) {
  const auto m = node.at("matrix").get<std::vector<double>>();
  glm::dmat3 axes(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
  glm::dvec3 scale(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
  if (glm::determinant(axes) < 0) scale.x = -scale.x;
  for (int axis = 0; axis < 3; ++axis) {
    if (scale[axis] != 0) axes[axis] /= scale[axis];
  }
  const glm::dquat turn = glm::quat_cast(axes);
  node.erase("matrix");
  node["translation"] = {m[12], m[13], m[14]};
  node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
  node["scale"] = {scale.x, scale.y, scale.z};
}

}  // namespace

std::optional<GltfProperty> find_property(const json& root, std::string_view pointer) {
  const auto steps = split_pointer(pointer);
  if (!steps || !can_change(steps->front())) return {};
  GltfProperty property;
  property.part = steps->front();
  property.steps = *steps;
  const json* value = &root;
  const Table* table = &tables().at("root");
  for (std::size_t step = 0; step < steps->size(); ++step) {
    const std::string& name = (*steps)[step];
    const Rule* const rule = find_rule(*table, name);
    if (rule == nullptr) return {};
    const bool is_owned = step == 2 && (property.part == "nodes" || property.part == "meshes");
    if (is_owned && name == "weights") return find_weights(root, std::move(property), step);
    if (step + 1 == steps->size()) return find_value(std::move(property), *rule);
    const auto found = value->find(name);
    if (found == value->end()) return {};
    value = &*found;
    if (rule->kind == Kind::objects) {
      if (++step >= steps->size()) return {};
      const auto index = to_index((*steps)[step], value->size());
      if (!index) return {};
      value = &value->at(*index);
    } else if (rule->kind != Kind::object) {
      return {};
    }
    table = &tables().at(rule->target);
  }
  return {};
}

void prepare_property(json& root, const GltfProperty& property) {
  if (property.steps.size() < 3 || (property.part != "nodes" && property.part != "meshes")) return;
  json& owner = value_at(root, {property.steps[0], property.steps[1]});
  const std::string& name = property.steps[2];
  const bool is_placing = name == "translation" || name == "rotation" || name == "scale";
  if (is_placing && owner.contains("matrix")) decompose_matrix(owner);
  if (name != "weights") return;
  const json& mesh = *find_mesh(root, property.steps);
  std::vector<double> weights;
  if (mesh.contains("weights")) weights = mesh.at("weights").get<std::vector<double>>();
  if (owner.contains("weights")) weights = owner.at("weights").get<std::vector<double>>();
  weights.resize(count_targets(mesh));
  owner["weights"] = weights;
}

void set_property(json& root, const GltfProperty& property, const std::vector<double>& values) {
  json& target = value_at(root, property.steps);
  switch (property.kind) {
    case GltfProperty::Kind::boolean:
      target = values.front() != 0;
      break;
    case GltfProperty::Kind::number:
      target = values.front();
      break;
    case GltfProperty::Kind::numbers:
      target = values;
      break;
  }
}

}  // namespace candil

#include "io/json_node.h"

#include <nlohmann/json.hpp>

#include "io/error.h"
#include "io/json_schema.h"
#include "io/resource.h"

namespace candil {

using nlohmann::json;

JsonNode::JsonNode(const JsonFile& file) : JsonNode(file, *file.root, "") {}

JsonNode::JsonNode(const JsonFile& file, const json& value, std::string place)
    : file_(&file), value_(&value), place_(std::move(place)) {}

void JsonNode::fail(const std::string& message) const { throw InputError(file_->name, place_, message); }

bool JsonNode::is_object() const { return value_->is_object(); }
bool JsonNode::is_array() const { return value_->is_array(); }
bool JsonNode::is_string() const { return value_->is_string(); }

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  const auto found = value_->find(std::string(key));
  if (found == value_->end()) return {};
  return JsonNode(*file_, *found, member_place(place_, printable(key)));
}

JsonNode JsonNode::operator[](std::string_view key) const {
  return {*file_, value_->at(std::string(key)), member_place(place_, printable(key))};
}

JsonNode JsonNode::operator[](std::size_t index) const {
  return {*file_, value_->at(index), element_place(place_, index)};
}

std::size_t JsonNode::size() const { return value_->size(); }

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, member] : value_->items()) keys.push_back(key);
  return keys;
}

float JsonNode::number() const { return value_->get<float>(); }
std::uint64_t JsonNode::integer() const { return value_->get<std::uint64_t>(); }
bool JsonNode::boolean() const { return value_->get<bool>(); }
std::string JsonNode::text() const { return value_->get<std::string>(); }
Vec2 JsonNode::vec2() const { return {value_->at(0).get<float>(), value_->at(1).get<float>()}; }
Vec3 JsonNode::vec3() const {
  return {value_->at(0).get<float>(), value_->at(1).get<float>(), value_->at(2).get<float>()};
}
Vec3 JsonNode::color() const { return is_array() ? vec3() : Vec3(number()); }

Vec3 JsonNode::direction() const {
  const glm::dvec3 v(value_->at(0).get<double>(), value_->at(1).get<double>(), value_->at(2).get<double>());
  const double length = glm::length(v);
  if (!(length > 1e-30)) fail("must not be zero");
  return Vec3(v / length);
}

float JsonNode::number(std::string_view key, float fallback) const {
  const std::optional<JsonNode> member = find(key);
  return member ? member->number() : fallback;
}

bool JsonNode::boolean(std::string_view key, bool fallback) const {
  const std::optional<JsonNode> member = find(key);
  return member ? member->boolean() : fallback;
}

std::string JsonNode::text(std::string_view key, std::string_view fallback) const {
  const std::optional<JsonNode> member = find(key);
  return member ? member->text() : std::string(fallback);
}

Vec3 JsonNode::vec3(std::string_view key, Vec3 fallback) const {
  const std::optional<JsonNode> member = find(key);
  return member ? member->vec3() : fallback;
}

Vec3 JsonNode::color(std::string_view key, Vec3 fallback) const {
  const std::optional<JsonNode> member = find(key);
  return member ? member->color() : fallback;
}

float JsonNode::radians(std::string_view key, float fallback_degrees) const {
  return glm::radians(number(key, fallback_degrees));
}

}  // namespace candil

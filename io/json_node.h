/// A value in a scene file together with where it stands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"

namespace candil {

/// One JSON scene file, checked against the schema; kept at one address while nodes refer to it.
struct JsonFile {
  std::string name;              ///< For messages.
  std::filesystem::path folder;  ///< What it refers to lies in here.
  std::shared_ptr<const nlohmann::json> root;
  std::filesystem::path path;
};

/// Reads what the schema has checked: types, counts and ranges need no further look. Small, passed by value.
class JsonNode {
 public:
  /// The root of a file.
  explicit JsonNode(const JsonFile& file);

  const JsonFile& file() const { return *file_; }
  /// "objects[3].radius".
  const std::string& place() const { return place_; }
  /// The same for all nodes of one value, different for others. (Places are cut where they are long.)
  const void* identity() const { return value_; }
  /// Throws InputError that names the file and the place.
  [[noreturn]] void fail(const std::string& message) const;

  bool is_object() const;
  bool is_array() const;
  bool is_string() const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  /// The member of an object, if it is there.
  std::optional<JsonNode> find(std::string_view key) const;
  /// A member that the schema requires.
  JsonNode operator[](std::string_view key) const;
  JsonNode operator[](std::size_t index) const;
  std::size_t size() const;
  /// Of an object, in alphabetical order.
  std::vector<std::string> keys() const;

  float number() const;
  std::uint64_t integer() const;
  bool boolean() const;
  std::string text() const;
  Vec2 vec2() const;
  Vec3 vec3() const;
  /// One number for all three, or three.
  Vec3 color() const;
  /// A vector of unit length; fails when it has no direction.
  Vec3 direction() const;

  // Members that may be absent.
  float number(std::string_view key, float fallback) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  Vec3 vec3(std::string_view key, Vec3 fallback) const;
  Vec3 color(std::string_view key, Vec3 fallback) const;
  /// Degrees in the file, radians here.
  float radians(std::string_view key, float fallback_degrees) const;

 private:
  JsonNode(const JsonFile& file, const nlohmann::json& value, std::string place);

  const JsonFile* file_;
  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace candil

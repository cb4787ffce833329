#include "io/gltf_schema.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "io/error.h"
#include "io/gltf_schema_tables.h"
#include "io/resource.h"

namespace candil {

namespace {

using nlohmann::json;

using gltf_schema::Kind;
using gltf_schema::Rule;
using gltf_schema::Table;
using gltf_schema::tables;

class SchemaCheck {
 public:
  SchemaCheck(json& root, const std::string& name) : root_(root), name_(name) {}

  /// Recursion is as deep as the tables nest, whatever the file says.
  void check_object(json& object, const Table& table, const std::string& place) const {
    if (!object.is_object()) fail(place, "must be an object");
    const auto extensions = object.find("extensions");
    if (extensions != object.end()) check_extensions(*extensions, joined(place, "extensions"));
    for (const Rule& rule : table) {
      const auto found = object.find(rule.property);
      if (found != object.end()) {
        check_value(*found, rule, joined(place, rule.property));
      } else if (rule.is_required) {
        fail(joined(place, rule.property), "is missing");
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw InputError(name_, place, message);
  }

  static std::string joined(const std::string& place, std::string_view property) {
    return place.empty() ? std::string(property) : place + "." + std::string(property);
  }

  void check_extensions(const json& extensions, const std::string& place) const {
    if (!extensions.is_object()) fail(place, "must be an object");
    for (const auto& [extension, value] : extensions.items()) {
      if (!value.is_object()) fail(place, "the member " + quoted_text(extension) + " must be an object");
    }
  }

  void check_value(json& value, const Rule& rule, const std::string& place) const {
    switch (rule.kind) {
      case Kind::boolean:
        if (!value.is_boolean()) fail(place, "must be true or false");
        break;
      case Kind::integer:
        check_integer(value, place, std::numeric_limits<std::int32_t>::max());
        if (!rule.target.empty()) check_listed(value.dump(), rule.target, place, value.dump());
        break;
      case Kind::integer_map:
        check_integer_map(value, place);
        break;
      case Kind::size:
        check_integer(value, place, std::uint64_t{1} << 48);
        break;
      case Kind::number:
        check_number(value, place);
        break;
      case Kind::string:
        if (!value.is_string()) fail(place, "must be a string");
        break;
      case Kind::word:
        check_word(value, rule.target, place);
        break;
      case Kind::reference:
        check_reference(value, rule.target, place);
        break;
      case Kind::object:
        check_object(value, tables().at(rule.target), place);
        break;
      case Kind::reference_map:
        check_reference_map(value, rule.target, place);
        break;
      case Kind::number_rows:
      case Kind::reference_rows:
        check_rows(value, rule, place);
        break;
      case Kind::numbers:
      case Kind::references:
      case Kind::reference_maps:
      case Kind::objects:
        check_array(value, rule, place);
        break;
    }
  }

  void check_word(const json& value, std::string_view words, const std::string& place) const {
    if (!value.is_string()) fail(place, "must be a string");
    const auto word = value.get<std::string>();
    check_listed(word.find(' ') == std::string::npos ? word : "", words, place, quoted_text(word));
  }

  /// That `word`, which has no blanks, is one of those between blanks. `shown`: what messages call it.
  void check_listed(const std::string& word, std::string_view words, const std::string& place,
                    const std::string& shown) const {
    const bool is_one = (" " + std::string(words) + " ").find(" " + word + " ") != std::string::npos;
    if (!is_one) fail(place, shown + " is none of: " + std::string(words));
  }

  void check_array(json& array, const Rule& rule, const std::string& place) const {
    if (!array.is_array()) fail(place, "must be an array");
    if (rule.length != 0 && array.size() != rule.length) {
      fail(place, "must have " + std::to_string(rule.length) + " elements, has " + std::to_string(array.size()));
    }
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (rule.kind == Kind::numbers) {
        check_number(array[i], place);
      } else {
        const std::string element = place + "[" + std::to_string(i) + "]";
        if (rule.kind == Kind::objects) check_object(array[i], tables().at(rule.target), element);
        if (rule.target == "animation") check_animation_samplers(array[i], element);
        if (rule.kind == Kind::references) check_reference(array[i], rule.target, element);
        if (rule.kind == Kind::reference_maps) check_reference_map(array[i], rule.target, element);
      }
    }
  }

  void check_rows(json& rows, const Rule& rule, const std::string& place) const {
    if (!rows.is_array()) fail(place, "must be an array");
    const Kind kind = rule.kind == Kind::number_rows ? Kind::numbers : Kind::references;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      check_array(rows[i], {rule.property, kind, rule.target, rule.is_required, rule.length},
                  place + "[" + std::to_string(i) + "]");
    }
  }

  void check_reference_map(json& map, std::string_view target, const std::string& place) const {
    if (!map.is_object()) fail(place, "must be an object");
    for (auto& [semantic, reference] : map.items()) {
      check_reference(reference, target, joined(place, printable(semantic)));
    }
  }

  void check_integer_map(json& map, const std::string& place) const {
    if (!map.is_object()) fail(place, "must be an object");
    for (auto& [name, value] : map.items()) {
      check_integer(value, joined(place, printable(name)), std::numeric_limits<std::int32_t>::max());
    }
  }

  void check_number(json& value, const std::string& place) const {
    if (!value.is_number()) fail(place, "must be a number");
    const double number = value.get<double>();
    if (std::abs(number) > std::numeric_limits<float>::max()) fail(place, "is too large a number");
    if (std::abs(number) > std::numeric_limits<int>::max()) value = number;
  }

  void check_integer(json& value, const std::string& place, std::uint64_t largest) const {
    if (value.is_number_float() && value.get<double>() == std::floor(value.get<double>()) &&
        std::abs(value.get<double>()) < 0x1p53) {
      value = static_cast<std::int64_t>(value.get<double>());
    }
    if (!value.is_number_integer()) fail(place, "must be an integer");
    if (!value.is_number_unsigned() && value.get<std::int64_t>() < 0) fail(place, "must not be negative");
    if (value.get<std::uint64_t>() > largest) fail(place, "is too large");
  }

  void check_reference(json& value, std::string_view target, const std::string& place) const {
    check_integer(value, place, std::numeric_limits<std::int32_t>::max());
    check_index(value, target_size(target), target, place);
  }

  void check_index(const json& value, std::size_t size, std::string_view target, const std::string& place) const {
    const auto index = value.get<std::size_t>();
    if (index < size) return;
    fail(place, "index " + std::to_string(index) + " does not exist: there " + (size == 1 ? "is " : "are ") +
                    std::to_string(size) + " in " + std::string(target));
  }

  /// The one reference whose target is not an array of the root.
  void check_animation_samplers(const json& animation, const std::string& place) const {
    const json& channels = animation.at("channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      check_index(channels[c].at("sampler"), animation.at("samplers").size(), "samplers",
                  place + ".channels[" + std::to_string(c) + "].sampler");
    }
  }

  std::size_t target_size(std::string_view target) const {
    static const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    static const json::json_pointer image_lights("/extensions/EXT_lights_image_based/lights");
    static const json::json_pointer variants("/extensions/KHR_materials_variants/variants");
    if (target == "lights") return size_at(lights);
    if (target == "variants") return size_at(variants);
    if (target == "image-based lights") return size_at(image_lights);
    const auto found = root_.find(target);
    return found != root_.end() && found->is_array() ? found->size() : 0;
  }

  std::size_t size_at(const json::json_pointer& array) const {
    return root_.contains(array) ? root_.at(array).size() : 0;
  }

  json& root_;
  const std::string& name_;
};

}  // namespace

void check_gltf_schema(json& root, const std::string& name) {
  SchemaCheck(root, name).check_object(root, tables().at("root"), {});
}

}  // namespace candil

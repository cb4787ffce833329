#include "io/json_schema.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "io/error.h"
#include "io/resource.h"

namespace candil {
namespace {

using nlohmann::json;

/// 8, 0.5, 1e+09: numbers of the schema as people write them.
std::string number_text(const json& number) {
  const double value = number.get<double>();
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  return value.is_number();
}

std::string with_article(const std::string& type) {
  if (type == "boolean") return "true or false";
  return (type == "object" || type == "array" || type == "integer" ? "an " : "a ") + type;
}

/// "a", "a or b", "a, b or c".
std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& words) {
  const std::string_view similar = most_similar(word, words);
  if (!similar.empty()) return "; did you mean " + quoted_text(similar) + "?";
  std::vector<std::string> all;
  for (const std::string_view known : words) all.push_back(quoted_text(known));
  return "; known: " + alternatives(all);
}

/// One walk over a value and its schema. It is as deep as the schema, which refers to nothing above itself.
class Check {
 public:
  Check(const json& root, const std::string& name) : root_(root), name_(name) {}

  void value(const json& value, const json& schema, const std::string& place) const {
    const json& rules = resolved(schema);
    if (rules.contains("oneOf")) return one_of(value, rules.at("oneOf"), place);
    if (rules.contains("enum")) return word(value, rules.at("enum"), place);
    if (rules.contains("const")) return;  // it chose this alternative
    const std::string type = rules.at("type");
    if (!has_type(value, type)) fail(place, "must be " + with_article(type));
    if (value.is_object()) object(value, rules, place);
    if (value.is_array()) array(value, rules, place);
    if (value.is_number()) number(value, rules, place);
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& message) const {
    throw InputError(name_, place, message);
  }

  const json& resolved(const json& schema) const {
    const json* rules = &schema;
    while (rules->contains("$ref")) {
      const std::string& reference = rules->at("$ref").get_ref<const std::string&>();
      rules = &root_.at(json::json_pointer(reference.substr(1)));
    }
    return *rules;
  }

  void number(const json& value, const json& rules, const std::string& place) const {
    const double number = value.get<double>();
    if (rules.at("type") == "integer" && number != std::floor(number)) fail(place, "must be an integer");
    if (rules.contains("minimum") && !(number >= rules.at("minimum").get<double>()))
      fail(place, "must be >= " + number_text(rules.at("minimum")));
    if (rules.contains("exclusiveMinimum") && !(number > rules.at("exclusiveMinimum").get<double>()))
      fail(place, "must be > " + number_text(rules.at("exclusiveMinimum")));
    if (rules.contains("maximum") && !(number <= rules.at("maximum").get<double>()))
      fail(place, "must be <= " + number_text(rules.at("maximum")));
  }

  void word(const json& value, const json& words, const std::string& place) const {
    if (!value.is_string()) fail(place, "must be a string");
    if (std::ranges::find(words, value) != words.end()) return;
    std::vector<std::string_view> known;
    for (const json& each : words) known.push_back(each.get_ref<const std::string&>());
    const std::string& text = value.get_ref<const std::string&>();
    fail(place, quoted_text(text) + " is not known" + suggestion(text, known));
  }

  void array(const json& value, const json& rules, const std::string& place) const {
    const std::size_t least = rules.value("minItems", std::size_t{0});
    const std::size_t most = rules.value("maxItems", std::numeric_limits<std::size_t>::max());
    if (value.size() < least || value.size() > most) {
      const std::string wanted = least == most          ? std::to_string(least)
                                 : value.size() < least ? "at least " + std::to_string(least)
                                                        : "at most " + std::to_string(most);
      fail(place, "must have " + wanted + " elements, has " + std::to_string(value.size()));
    }
    for (std::size_t i = 0; i < value.size(); ++i) this->value(value[i], rules.at("items"), element_place(place, i));
  }

  void object(const json& value, const json& rules, const std::string& place) const {
    static const json none = json::object();
    const json& properties = rules.contains("properties") ? rules.at("properties") : none;
    const json& others = rules.at("additionalProperties");
    for (const auto& [key, member] : value.items()) {
      const bool is_known = properties.contains(key);
      if (!is_known && !others.is_object()) fail_unknown(key, properties, place);
      this->value(member, is_known ? properties.at(key) : others, member_place(place, printable(key)));
    }
    if (!rules.contains("required")) return;
    for (const std::string key : rules.at("required"))
      if (!value.contains(key)) fail(member_place(place, key), "is missing");
  }

  [[noreturn]] void fail_unknown(const std::string& key, const json& properties, const std::string& place) const {
    std::vector<std::string_view> known;
    for (const auto& [name, rules] : properties.items()) known.push_back(name);
    fail(member_place(place, printable(key)), "is not known" + suggestion(key, known));
  }

  void one_of(const json& value, const json& schemas, const std::string& place) const {
    std::vector<const json*> candidates;
    std::vector<std::string> types;
    for (const json& schema : schemas) {
      const json& rules = resolved(schema);
      collect(value, rules, candidates, types);
    }
    if (candidates.empty()) fail(place, "must be " + alternatives(types));
    const json* chosen = candidates.front();
    if (candidates.size() > 1)
      chosen = is_told_by_type(*chosen) ? choose_by_type(value, candidates, place)
                                        : choose_by_required(value, candidates, place);
    this->value(value, *chosen, place);
  }

  /// Alternatives of the type of the value; those that are alternatives themselves bring theirs.
  void collect(const json& value, const json& rules, std::vector<const json*>& candidates,
               std::vector<std::string>& types) const {
    if (rules.contains("oneOf")) {
      for (const json& schema : rules.at("oneOf")) collect(value, resolved(schema), candidates, types);
      return;
    }
    const std::string type = rules.at("type");
    if (has_type(value, type)) candidates.push_back(&rules);
    if (std::ranges::find(types, with_article(type)) == types.end()) types.push_back(with_article(type));
  }

  static bool is_told_by_type(const json& rules) {
    return rules.contains("properties") && rules.at("properties").contains("type");
  }

  const json* choose_by_type(const json& value, const std::vector<const json*>& candidates,
                             const std::string& place) const {
    if (!value.contains("type")) fail(member_place(place, "type"), "is missing");
    const json& wanted = value.at("type");
    std::vector<std::string_view> known;
    std::vector<const json*> chosen;
    for (const json* rules : candidates) {
      const json& type = rules->at("properties").at("type").at("const");
      if (type == wanted) chosen.push_back(rules);
      const std::string_view name = type.get_ref<const std::string&>();
      if (std::ranges::find(known, name) == known.end()) known.push_back(name);
    }
    if (chosen.size() == 1) return chosen.front();
    if (chosen.size() > 1) return choose_by_required(value, chosen, place);
    if (!wanted.is_string()) fail(member_place(place, "type"), "must be a string");
    const std::string& text = wanted.get_ref<const std::string&>();
    fail(member_place(place, "type"), quoted_text(text) + " is not known" + suggestion(text, known));
  }

  const json* choose_by_required(const json& value, const std::vector<const json*>& candidates,
                                 const std::string& place) const {
    std::vector<std::string> wanted;
    for (const json* rules : candidates) {
      const std::string& key = rules->at("required").front().get_ref<const std::string&>();
      if (value.contains(key)) return rules;
      wanted.push_back(quoted_text(key));
    }
    fail(place, "must have " + alternatives(wanted));
  }

  const json& root_;
  const std::string& name_;
};

void check_keywords(const json& schema) {
  static constexpr std::string_view known[] = {
      "$schema",    "title",    "description", "definitions", "$ref",     "oneOf",
      "type",       "const",    "enum",        "items",       "required", "additionalProperties",
      "properties", "minItems", "maxItems",    "minimum",     "maximum",  "exclusiveMinimum"};
  for (const auto& [keyword, rules] : schema.items()) {
    if (std::ranges::find(known, keyword) == std::end(known)) throw std::invalid_argument("unknown keyword " + keyword);
    if (keyword == "properties" || keyword == "definitions") {
      for (const json& each : rules) check_keywords(each);
    } else if (keyword == "oneOf") {
      for (const json& each : rules) check_keywords(each);
    } else if (keyword == "items" || (keyword == "additionalProperties" && rules.is_object())) {
      check_keywords(rules);
    }
  }
}

}  // namespace

std::string member_place(const std::string& place, std::string_view key) {
  return place.empty() ? std::string(key) : place + "." + std::string(key);
}

std::string element_place(const std::string& place, std::size_t index) {
  return place + "[" + std::to_string(index) + "]";
}

std::string_view most_similar(std::string_view word, const std::vector<std::string_view>& words) {
  if (word.size() > 64) return {};
  std::string_view best;
  std::size_t least = word.size() / 3 + 2;
  for (const std::string_view other : words) {
    if (other.size() >= word.size() + least) continue;  // the distance is no less than the difference in length
    std::vector<std::size_t> row(other.size() + 1);  // distances from the letters of `word` so far to those of `other`
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < other.size(); ++j) {
        const std::size_t substituted = diagonal + (word[i] == other[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
      }
    }
    if (row.back() < least) best = other, least = row.back();
  }
  return best;
}

JsonSchema::JsonSchema(std::string_view text) {
  try {
    root_ = std::make_shared<const json>(json::parse(text));
  } catch (const json::exception& error) {
    throw std::invalid_argument(error.what());
  }
  check_keywords(*root_);
}

void JsonSchema::check(const json& value, const std::string& name) const {
  Check(*root_, name).value(value, *root_, "");
}

}  // namespace candil

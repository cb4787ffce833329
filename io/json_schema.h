/// Checks JSON against a schema (JSON Schema draft 7, the keywords that candil-scene.schema.json uses), with messages
/// for people who write scenes by hand.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace candil {

/// `type` (one), `const`, `enum`, `properties`, `required`, `additionalProperties`, `items` (one), `minItems`,
/// `maxItems`, `minimum`, `maximum`, `exclusiveMinimum`, `$ref` (local), and `oneOf` with alternatives that can be told
/// apart: by their type, by the `const` of their property "type", or by the first property that they require.
class JsonSchema {
 public:
  /// Throws std::invalid_argument for text that is no schema of this kind, any unknown keyword included.
  explicit JsonSchema(std::string_view text);

  /// Throws InputError(name, place, ...) for the first value that breaks the schema, with a place like
  /// "objects[3].radius". A property that is not known is answered with the most similar one that is.
  void check(const nlohmann::json& value, const std::string& name) const;

 private:
  std::shared_ptr<const nlohmann::json> root_;
};

/// The schema of candil's own scene files, as installed.
const JsonSchema& scene_schema();

/// "objects" and "radius" to "objects.radius"; `place` may be empty.
std::string member_place(const std::string& place, std::string_view key);
std::string element_place(const std::string& place, std::size_t index);

/// Of `words`, the one that is most similar to `word` (least Levenshtein distance), if it is similar at all: at most a
/// third of the letters differ.
std::string_view most_similar(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace candil

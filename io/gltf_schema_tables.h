/// The properties that glTF objects may have, as data. check_gltf_schema() interprets it.
#pragma once

#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

namespace candil::gltf_schema {

/// What a property must be. `integer` has 31 bits, `size` (of bytes or elements) more; `integer_map` has integers under
/// any names. `reference`: an index into the root array that Rule::target names. `object` and `objects` (an array): of
/// the table that Rule::target names. `word`: one of those that Rule::target lists. `..._rows`: arrays in an array.
enum class Kind {
  boolean,
  integer,
  integer_map,
  size,
  number,
  string,
  word,
  numbers,
  reference,
  references,
  reference_map,
  reference_maps,
  object,
  objects,
  number_rows,
  reference_rows
};

struct Rule {
  std::string_view property;
  Kind kind;
  std::string_view target = {};  ///< What is referred to, or the words or integers that may stand there.
  bool is_required = false;
  std::size_t length = 0;  ///< Of an array of numbers, or of each row; 0: any.
};

using Table = std::vector<Rule>;

/// By the kind of object: "root", "accessor", "sparse indices" and so on, as Rule::target names them.
const std::map<std::string_view, Table>& tables();

}  // namespace candil::gltf_schema

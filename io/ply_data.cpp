#include "io/ply_data.h"

#include <algorithm>
#include <utility>

#include "core/math.h"
#include "io/error.h"
#include "io/ply_source.h"
#include "io/resource.h"

namespace candil {

namespace {

/// Where the values of one property go; nowhere: it is skipped.
struct Target {
  std::vector<float>* values = nullptr;
  PlyLists<std::uint32_t>* indices = nullptr;
  PlyLists<float>* lists = nullptr;
  bool may_restart = false;  ///< Of indices: -1 is allowed.
};

[[noreturn]] void fail_out_of_range(std::int64_t index, std::uint64_t vertex_count) {
  throw PlyValueError{"vertex " + std::to_string(index) + " is out of range, there are " +
                      std::to_string(vertex_count)};
}

std::uint32_t vertex_index(std::int64_t index, std::uint64_t vertex_count, bool may_restart) {
  if (static_cast<std::uint64_t>(index) < vertex_count) return static_cast<std::uint32_t>(index);
  if (may_restart && (index == -1 || index == invalid_id)) return invalid_id;
  fail_out_of_range(index, vertex_count);
}

template <class Source>
void read_list(Source& source, const PlyProperty& property, const Target& target, std::uint64_t vertex_count) {
  const std::int64_t size = source.integer(*property.count_type);
  if (size < 0) throw PlyValueError{"a list has " + std::to_string(size) + " values"};
  const auto count = static_cast<std::uint64_t>(size);
  if (count > source.most_values(property.type) || count >= invalid_id)
    throw PlyValueError{"a list claims " + std::to_string(size) + " values, the file has not that many left"};
  if (target.indices != nullptr) {
    target.indices->sizes.push_back(static_cast<std::uint32_t>(count));
    const std::size_t first = target.indices->values.size();
    target.indices->values.resize(first + count);
    std::uint32_t* next = target.indices->values.data() + first;
    source.for_each_integer(property.type, count, [&](std::int64_t index) {
      *next++ = vertex_index(index, vertex_count, target.may_restart);
    });
  } else if (target.lists != nullptr) {
    target.lists->sizes.push_back(static_cast<std::uint32_t>(count));
    for (std::uint64_t i = 0; i < count; ++i)
      target.lists->values.push_back(static_cast<float>(source.number(property.type)));
  } else {
    source.skip(property.type, count);
  }
}

template <class Source>
void read_row(Source& source, const PlyElement& element, const std::vector<Target>& targets, std::uint64_t row,
              std::uint64_t vertex_count) {
  for (std::size_t p = 0; p < targets.size(); ++p) {
    const PlyProperty& property = element.properties[p];
    if (property.is_list()) {
      read_list(source, property, targets[p], vertex_count);
    } else if (targets[p].values != nullptr) {
      (*targets[p].values)[row] = static_cast<float>(source.number(property.type));
    } else {
      source.skip(property.type, 1);
    }
  }
}

class DataReader {
 public:
  DataReader(const PlyHeader& header, const std::string& file, std::vector<std::string>& warnings)
      : header_(header), file_(file), warnings_(warnings) {}

  template <class Source>
  PlyData read(Source source) {
    const PlyElement* const vertices = header_.find("vertex");
    if (vertices == nullptr) throw InputError(file_, "header", "has no element vertex");
    if (vertices->count >= invalid_id) throw InputError(file_, "element vertex", "has too many rows");
    data_.vertex_count = vertices->count;
    for (const PlyElement& element : header_.elements) read_element(source, element);
    if (!source.is_at_end()) warnings_.push_back("the file has more data than its header tells, it is ignored");
    return std::move(data_);
  }

 private:
  template <class Source>
  void read_element(Source& source, const PlyElement& element) {
    const std::uint64_t most = source.most_rows(element);
    if (element.count > most) {
      throw InputError(file_, "element " + printable(element.name),
                       "claims " + std::to_string(element.count) + " rows, the file has bytes for " +
                           std::to_string(most) + " at most");
    }
    const std::vector<Target> targets = choose_targets(element);
    if (targets.empty()) return;
    for (const Target& target : targets) {
      if (target.values != nullptr) target.values->resize(element.count);
      if (target.indices != nullptr) target.indices->sizes.reserve(element.count);
      if (target.indices != nullptr) target.indices->values.reserve(3 * element.count);
    }
    std::uint64_t row = 0, long_rows = 0;
    try {
      for (; row < element.count; ++row) {
        read_row(source, element, targets, row, data_.vertex_count);
        if (source.end_row()) ++long_rows;
      }
    } catch (const PlyValueError& error) {
      throw InputError(file_, "element " + printable(element.name) + ", row " + std::to_string(row), error.message);
    }
    if (long_rows > 0)
      warnings_.push_back("element " + printable(element.name) + ": " + std::to_string(long_rows) +
                          " rows have more values than the header tells, they are ignored");
  }

  std::vector<Target> choose_targets(const PlyElement& element) {
    element_ = &element;
    targets_.assign(element.properties.size(), {});
    if (element.name == "vertex") choose_vertex_targets();
    if (element.name == "face") choose_face_targets();
    if (element.name == "tristrips") {
      const std::size_t list = find({"vertex_indices", "vertex_index"}, true);
      if (list < targets_.size()) targets_[list] = {.indices = &data_.strips, .may_restart = true};
    }
    return std::move(targets_);
  }

  void choose_vertex_targets() {
    for (const auto& [name, values] : {std::pair("x", &data_.x), std::pair("y", &data_.y), std::pair("z", &data_.z)})
      if (!keep({name}, *values)) throw InputError(file_, "element vertex", "has no property " + std::string(name));
    keep_all({{{"nx", "normal_x"}, &data_.normal_x, nullptr},
              {{"ny", "normal_y"}, &data_.normal_y, nullptr},
              {{"nz", "normal_z"}, &data_.normal_z, nullptr}});
    keep_all({{{"u", "s", "texture_u", "texture_s", "tx"}, &data_.u, nullptr},
              {{"v", "t", "texture_v", "texture_t", "ty"}, &data_.v, nullptr}});
    const bool has_colors = keep_all({{{"red", "diffuse_red", "r"}, &data_.red, &data_.red_type},
                                      {{"green", "diffuse_green", "g"}, &data_.green, &data_.green_type},
                                      {{"blue", "diffuse_blue", "b"}, &data_.blue, &data_.blue_type}});
    if (has_colors) keep_all({{{"alpha", "diffuse_alpha", "a"}, &data_.alpha, &data_.alpha_type}});
  }

  void choose_face_targets() {
    const std::size_t list = find({"vertex_indices", "vertex_index"}, true);
    if (list == targets_.size()) throw InputError(file_, "element face", "has no list vertex_indices");
    targets_[list].indices = &data_.faces;
    const std::size_t uvs = find({"texcoord"}, true);
    if (uvs < targets_.size()) targets_[uvs].lists = &data_.face_uvs;
    if (data_.red.empty() && find({"red", "diffuse_red"}, false) < targets_.size())
      data_.left_out.push_back("colours of faces");
  }

  /// The first property with one of the names; as many as there are properties if there is none.
  std::size_t find(const std::vector<std::string_view>& names, bool is_list) const {
    for (const std::string_view name : names) {
      const auto found = std::ranges::find_if(element_->properties, [&](const PlyProperty& property) {
        return property.name == name && property.is_list() == is_list;
      });
      if (found != element_->properties.end()) return static_cast<std::size_t>(found - element_->properties.begin());
    }
    return element_->properties.size();
  }

  bool keep(const std::vector<std::string_view>& names, std::vector<float>& values) {
    const std::size_t p = find(names, false);
    if (p < targets_.size()) targets_[p].values = &values;
    return p < targets_.size();
  }

  struct Choice {
    std::vector<std::string_view> names;
    std::vector<float>* values;
    PlyType* type;
  };

  /// Keeps them all, or none when one of them is missing.
  bool keep_all(const std::vector<Choice>& choices) {
    for (const Choice& choice : choices)
      if (find(choice.names, false) == targets_.size()) return false;
    for (const Choice& choice : choices) {
      keep(choice.names, *choice.values);
      if (choice.type != nullptr) *choice.type = element_->properties[find(choice.names, false)].type;
    }
    return true;
  }

  const PlyHeader& header_;
  const std::string& file_;
  std::vector<std::string>& warnings_;
  PlyData data_;
  const PlyElement* element_ = nullptr;
  std::vector<Target> targets_;
};

}  // namespace

PlyData read_ply_data(const PlyHeader& header, std::string_view bytes, const std::string& file,
                      std::vector<std::string>& warnings) {
  DataReader reader(header, file, warnings);
  const std::string_view rows = bytes.substr(header.size);
  if (header.format == PlyFormat::ascii) return reader.read(PlyText(rows));
  if (header.format == PlyFormat::big_endian) return reader.read(PlyBytes<true>(rows));
  return reader.read(PlyBytes<false>(rows));
}

}  // namespace candil

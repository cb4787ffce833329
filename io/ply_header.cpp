#include "io/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "io/error.h"
#include "io/resource.h"

namespace candil {

namespace {

constexpr std::string_view blanks = " \t\v\f";

std::optional<PlyType> parse_type(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{{"char", PlyType::int8},
                                                                        {"int8", PlyType::int8},
                                                                        {"uchar", PlyType::uint8},
                                                                        {"uint8", PlyType::uint8},
                                                                        {"short", PlyType::int16},
                                                                        {"int16", PlyType::int16},
                                                                        {"ushort", PlyType::uint16},
                                                                        {"uint16", PlyType::uint16},
                                                                        {"int", PlyType::int32},
                                                                        {"int32", PlyType::int32},
                                                                        {"uint", PlyType::uint32},
                                                                        {"uint32", PlyType::uint32},
                                                                        {"float", PlyType::float32},
                                                                        {"float32", PlyType::float32},
                                                                        {"double", PlyType::float64},
                                                                        {"float64", PlyType::float64}}};
  const auto* found = std::ranges::find(names, word, &std::pair<std::string_view, PlyType>::first);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

/// The lines of a header, and how they end: a file with bare CR may have LF as its first byte of data.
class HeaderLines {
 public:
  explicit HeaderLines(std::string_view bytes) : bytes_(bytes) {}

  /// Without its end; nothing when the file is over.
  std::optional<std::string_view> next() {
    if (position_ == bytes_.size()) return {};
    const std::size_t begin = position_;
    const std::size_t end = std::min(bytes_.find_first_of("\r\n", begin), bytes_.size());
    position_ = std::min(end + 1, bytes_.size());
    const bool is_pair = bytes_.substr(end).starts_with("\r\n");
    if (number_ == 0) ends_in_bare_cr_ = !is_pair && bytes_.substr(end).starts_with('\r');
    if (is_pair && !ends_in_bare_cr_) ++position_;
    ++number_;
    return bytes_.substr(begin, end - begin);
  }

  std::size_t position() const { return position_; }
  std::size_t number() const { return number_; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0, number_ = 0;
  bool ends_in_bare_cr_ = false;
};

/// Takes the first word off `line`; empty at its end.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings)
      : lines_(bytes), file_(file), warnings_(warnings) {}

  PlyHeader parse() {
    auto line = lines_.next();
    if (!line) throw InputError(file_, "", "is empty");
    if (take_word(*line) != "ply") fail("does not begin with \"ply\"");
    while ((line = lines_.next())) {
      std::string_view rest = *line;
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") return finish();
      if (keyword == "format") {
        parse_format(rest);
      } else if (keyword == "element") {
        parse_element(rest);
      } else if (keyword == "property") {
        parse_property(rest);
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        if (unknown_lines_++ == 0) first_unknown_ = place() + ": " + quoted_text(keyword) + " is no keyword, ignored";
      }
    }
    throw InputError(file_, "header", "has no end_header");
  }

 private:
  std::string place() const { return "header, line " + std::to_string(lines_.number()); }
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, place(), message); }

  void parse_format(std::string_view rest) {
    const std::string_view name = take_word(rest), version = take_word(rest);
    if (version != "1.0") fail("version " + quoted_text(version) + " is unknown, only 1.0 is");
    if (has_format_) fail("the format is given twice");
    has_format_ = true;
    if (name == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      header_.format = PlyFormat::little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyFormat::big_endian;
    } else {
      fail("format " + quoted_text(name) + " is unknown");
    }
  }

  void parse_element(std::string_view rest) {
    PlyElement element;
    element.name = take_word(rest);
    const std::string_view count = take_word(rest);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
      fail(quoted_text(count) + " is no number of rows");
    if (header_.find(element.name) != nullptr) fail("element " + quoted_text(element.name) + " is there twice");
    constexpr std::size_t most = 1000;  // each is looked for among all
    if (header_.elements.size() == most) fail("there are more than 1000 elements");
    header_.elements.push_back(std::move(element));
  }

  void parse_property(std::string_view rest) {
    if (header_.elements.empty()) fail("a property comes before the first element");
    PlyProperty property;
    std::string_view type = take_word(rest);
    if (type == "list") {
      property.count_type = required_type(take_word(rest));
      if (!is_integer(*property.count_type)) fail("the length of a list must be an integer");
      type = take_word(rest);
    }
    property.type = required_type(type);
    property.name = take_word(rest);
    if (property.name.empty()) fail("a property has no name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType required_type(std::string_view word) const {
    const auto type = parse_type(word);
    if (!type) fail(quoted_text(word) + " is no type");
    return *type;
  }

  PlyHeader finish() {
    if (!has_format_) throw InputError(file_, "header", "has no format");
    if (unknown_lines_ > 1) first_unknown_ += ", and so are " + std::to_string(unknown_lines_ - 1) + " more lines";
    if (unknown_lines_ > 0) warnings_.push_back(first_unknown_);
    header_.size = lines_.position();
    return std::move(header_);
  }

  HeaderLines lines_;
  const std::string& file_;
  std::vector<std::string>& warnings_;
  PlyHeader header_;
  bool has_format_ = false;
  std::size_t unknown_lines_ = 0;
  std::string first_unknown_;  // the warning about the first of them
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_integer(PlyType type) { return type < PlyType::float32; }

std::size_t PlyElement::least_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties) bytes += size_of(property.count_type.value_or(property.type));
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(elements, name, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings) {
  return HeaderParser(bytes, file, warnings).parse();
}

}  // namespace candil

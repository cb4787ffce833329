#include "io/ply_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/resource.h"

namespace candil {

namespace {

constexpr bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void fail_at_end() { throw PlyValueError{"the file ends here"}; }

std::int64_t integer_of(double value) {
  constexpr double most = 0x1p53;
  if (!(std::abs(value) <= most) || value != std::floor(value)) throw PlyValueError{"a value must be an integer"};
  return static_cast<std::int64_t>(value);
}

std::string_view PlyText::next_word() {
  std::size_t begin = 0;
  while (begin < text_.size() && is_blank(text_[begin])) ++begin;
  std::size_t end = begin;
  while (end < text_.size() && !is_blank(text_[end])) ++end;
  if (begin == end) fail_at_end();
  const std::string_view word = text_.substr(begin, end - begin);
  text_.remove_prefix(end);
  return word;
}

double PlyText::number(PlyType) {
  const std::string_view word = next_word();
  const char* const last = word.data() + word.size();
  double value = 0;
  const auto [end, error] = std::from_chars(word.data() + (word.front() == '+' ? 1 : 0), last, value);
  if (end != last || error == std::errc::invalid_argument) throw PlyValueError{quoted_text(word) + " is not a number"};
  if (error == std::errc::result_out_of_range)
    return word.find("e-") == std::string_view::npos && word.find("E-") == std::string_view::npos
               ? std::numeric_limits<double>::infinity()
               : 0.0;
  return value;
}

std::int64_t PlyText::integer(PlyType type) {
  const std::string_view before = text_;
  const std::string_view word = next_word();
  const char* const last = word.data() + word.size();
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), last, value);
  if (end == last && error == std::errc()) return value;
  text_ = before;  // some programs write "3.0"
  return integer_of(number(type));
}

void PlyText::skip(PlyType type, std::uint64_t count) {
  if (count > most_values(type)) fail_at_end();
  for (std::uint64_t i = 0; i < count; ++i) next_word();
}

std::uint64_t PlyText::most_rows(const PlyElement& element) const {
  if (element.properties.empty()) return std::numeric_limits<std::uint64_t>::max();
  return most_values(PlyType::uint8) / element.properties.size();
}

bool PlyText::end_row() {
  const std::string_view rest = text_.substr(0, text_.find_first_of("\r\n"));
  text_.remove_prefix(rest.size());
  return !std::ranges::all_of(rest, is_blank);
}

bool PlyText::is_at_end() {
  while (!text_.empty() && is_blank(text_.front())) text_.remove_prefix(1);
  return text_.empty();
}

}  // namespace candil

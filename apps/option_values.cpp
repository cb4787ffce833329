#include "apps/option_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/usage_error.h"

namespace candil {
namespace {

template <typename Number>
std::optional<Number> to_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number number{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

NameWithParameters split_parameters(std::string_view text) {
  const std::size_t colon = text.find(':');
  NameWithParameters result{text.substr(0, colon), {}};
  if (colon == std::string_view::npos) return result;
  for (const std::string_view part : split(text.substr(colon + 1), ',')) {
    const std::size_t equals = std::min(part.find('='), part.size());
    result.parameters.push_back({part.substr(0, equals), part.substr(std::min(equals + 1, part.size()))});
  }
  return result;
}

double parse_real(std::string_view option, std::string_view text, double low, double high) {
  const std::optional<double> value = to_number<double>(text);
  if (!value || !std::isfinite(*value)) throw UsageError(fmt::format("{}: '{}' is not a number", option, text));
  if (*value < low || *value > high)
    throw UsageError(fmt::format("{}: {} is not between {:g} and {:g}", option, text, low, high));
  return *value;
}

std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high) {
  const std::optional<std::uint64_t> value = to_number<std::uint64_t>(text);
  if (!value || *value < low || *value > high)
    throw UsageError(fmt::format("{}: '{}' is not a whole number from {} to {}", option, text, low, high));
  return *value;
}

std::vector<float> parse_reals(std::string_view option, std::string_view text, std::size_t least, std::size_t most,
                               double largest) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() < least || parts.size() > most) {
    const std::string count = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    throw UsageError(fmt::format("{}: '{}' is not {} numbers with commas between them", option, text, count));
  }
  std::vector<float> values;
  for (const std::string_view part : parts)
    values.push_back(static_cast<float>(parse_real(option, part, -largest, largest)));
  return values;
}

Vec3 parse_vector(std::string_view option, std::string_view text, double largest) {
  const std::vector<float> values = parse_reals(option, text, 3, 3, largest);
  return {values[0], values[1], values[2]};
}

ImageSize parse_size(std::string_view option, std::string_view text) {
  const std::vector<std::string_view> parts = split(text, 'x');
  ImageSize size;
  if (parts.size() == 2) {
    size.width = to_number<int>(parts[0]).value_or(0);
    size.height = to_number<int>(parts[1]).value_or(0);
  }
  if (size.width < 1 || size.height < 1 || size.width > max_image_side || size.height > max_image_side)
    throw UsageError(
        fmt::format("{}: '{}' is not a size like 1024x768, 1 to {} pixels on a side", option, text, max_image_side));
  return size;
}

void fail_choice(std::string_view option, std::string_view text, const std::vector<std::string>& allowed) {
  throw UsageError(fmt::format("{}: '{}' is not one of {}", option, text, fmt::join(allowed, ", ")));
}

}  // namespace candil

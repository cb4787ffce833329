/// Values of options out of the words of a command line. All throw UsageError with one line that names the option.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"

namespace candil {

struct ImageSize {
  int width = 0, height = 0;  ///< Pixels.
};

/// A finite number in [low, high].
double parse_real(std::string_view option, std::string_view text, double low, double high);
/// A whole number in [low, high].
std::uint64_t parse_integer(std::string_view option, std::string_view text, std::uint64_t low, std::uint64_t high);
/// Between `least` and `most` numbers in [-largest, largest] with commas between them.
std::vector<float> parse_reals(std::string_view option, std::string_view text, std::size_t least, std::size_t most,
                               double largest);
/// Three such numbers.
Vec3 parse_vector(std::string_view option, std::string_view text, double largest);
/// "1920x1080": each from 1 to max_image_side.
ImageSize parse_size(std::string_view option, std::string_view text);
inline constexpr int max_image_side = 32768;

/// The parts between separators, empty ones too; at least one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// "NAME", or "NAME:KEY=VALUE,KEY=VALUE...". A parameter without "=" has an empty value.
struct NameWithParameters {
  struct Parameter {
    std::string_view key, value;
  };
  std::string_view name;
  std::vector<Parameter> parameters;
};
/// Views of `text`.
NameWithParameters split_parameters(std::string_view text);

/// Throws UsageError that lists the words that are allowed.
[[noreturn]] void fail_choice(std::string_view option, std::string_view text, const std::vector<std::string>& allowed);

}  // namespace candil

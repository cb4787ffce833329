#include "apps/accelerator_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

/// The place of `value` among `words`; throws where it is none of them.
std::size_t parse_word(const std::string& option, std::string_view value, const std::vector<std::string>& words) {
  const auto found = std::ranges::find(words, value);
  if (found == words.end()) fail_choice(option, value, words);
  return static_cast<std::size_t>(found - words.begin());
}

/// The keys that a kind knows.
std::vector<std::string> keys_of(AcceleratorKind kind) {
  switch (kind) {
    case AcceleratorKind::embree:
      return {"quality", "robust", "compact", "isa", "frequency"};
    case AcceleratorKind::wide:
      return {"quality", "compact", "isa"};
    case AcceleratorKind::sah:
      return {"quality"};
    case AcceleratorKind::report:
    case AcceleratorKind::brute:
      break;
  }
  return {};
}

void set_option(AcceleratorOptions& options, const std::string& option, std::string_view key, std::string_view value) {
  const std::vector<std::string> keys = keys_of(options.kind);
  if (keys.empty()) throw UsageError(fmt::format("{}: {} has no options", option, accelerator_name(options.kind)));
  if (std::ranges::find(keys, key) == keys.end()) fail_choice(option, key, keys);
  const std::string name = fmt::format("{}: {}", option, key);
  if (key == "quality") {
    constexpr std::array qualities = {BuildQuality::low, BuildQuality::medium, BuildQuality::high};
    options.quality = qualities[parse_word(name, value, {"low", "medium", "high"})];
  } else if (key == "robust") {
    options.is_robust = parse_word(name, value, {"off", "on"}) == 1;
  } else if (key == "compact") {
    options.is_compact = parse_word(name, value, {"off", "on"}) == 1;
  } else if (key == "isa") {
    if (options.kind == AcceleratorKind::wide) {
      parse_word(name, value, wide_instruction_sets());
    } else {
      parse_word(name, value, {"sse2", "sse4.2", "avx", "avx2", "avx512"});
    }
    options.isa = value;
  } else {
    parse_word(name, value, {"simd128", "simd256", "simd512"});
    options.frequency_level = value;
  }
}

}  // namespace

AcceleratorOptions parse_accelerator(std::string_view option, std::string_view text) {
  const std::string place(option);
  const auto [name, parameters] = split_parameters(text);
  const std::optional<AcceleratorKind> kind = accelerator_from_name(name);
  if (!kind) fail_choice(place, name, accelerator_names());
  AcceleratorOptions options;
  options.kind = *kind;
  for (const auto& [key, value] : parameters) {
    set_option(options, place, key, value);
  }
  return options;
}

}  // namespace candil

#include "apps/tonemap_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

/// The text up to `separator`, which goes together with it; all of the text where there is none.
std::string_view take_part(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

[[noreturn]] void fail_parameter(std::string_view option, std::string_view key, const std::string& name,
                                 std::span<const TonemapParameter> allowed) {
  if (allowed.empty()) throw UsageError(fmt::format("{}: {} takes no parameters, not '{}'", option, name, key));
  std::vector<std::string_view> names;
  for (const TonemapParameter& parameter : allowed) names.push_back(parameter.name);
  throw UsageError(
      fmt::format("{}: '{}' is not a parameter of {}, which takes {}", option, key, name, fmt::join(names, ", ")));
}

void set_parameter(Tonemap& tonemap, std::string_view option, std::string_view assignment) {
  const std::string name = tonemap_name(tonemap.kind);
  const std::span<const TonemapParameter> allowed = tonemap_parameters(tonemap.kind);
  std::string_view value = assignment;
  const std::string_view key = take_part(value, '=');
  for (const TonemapParameter& parameter : allowed)
    if (parameter.name == key) {
      const std::string place = fmt::format("{}: {}:{}", option, name, key);
      tonemap.*parameter.field = parse_real(place, value, parameter.low, parameter.high);
      return;
    }
  fail_parameter(option, key, name, allowed);
}

}  // namespace

Tonemap parse_tonemap(std::string_view option, std::string_view text) {
  std::string_view parameters = text;
  const std::string_view name = take_part(parameters, ':');
  const std::optional<TonemapKind> kind = tonemap_from_name(name);
  if (!kind) fail_choice(option, name, tonemap_names());
  Tonemap tonemap = make_tonemap(*kind);
  if (name.size() == text.size()) return tonemap;
  do set_parameter(tonemap, option, take_part(parameters, ','));
  while (!parameters.empty());
  return tonemap;
}

std::string tonemap_help() {
  std::string help;
  for (const std::string& name : tonemap_names()) {
    const TonemapKind kind = *tonemap_from_name(name);
    help += fmt::format("  {:<16}{}\n", name, tonemap_summary(kind));
    for (const TonemapParameter& parameter : tonemap_parameters(kind))
      help += fmt::format("    {:<14}{} (default {:g}, {:g} to {:g})\n", parameter.name, parameter.summary,
                          parameter.initial, parameter.low, parameter.high);
  }
  return help;
}

}  // namespace candil

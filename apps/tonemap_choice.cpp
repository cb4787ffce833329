#include "apps/tonemap_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

[[noreturn]] void fail_parameter(std::string_view option, std::string_view key, const std::string& name,
                                 std::span<const TonemapParameter> allowed) {
  if (allowed.empty()) throw UsageError(fmt::format("{}: {} takes no parameters, not '{}'", option, name, key));
  std::vector<std::string_view> names;
  for (const TonemapParameter& parameter : allowed) names.push_back(parameter.name);
  throw UsageError(
      fmt::format("{}: '{}' is not a parameter of {}, which takes {}", option, key, name, fmt::join(names, ", ")));
}

void set_parameter(Tonemap& tonemap, std::string_view option, std::string_view key, std::string_view value) {
  const std::string name = tonemap_name(tonemap.kind);
  const std::span<const TonemapParameter> allowed = tonemap_parameters(tonemap.kind);
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
  const auto [name, parameters] = split_parameters(text);
  const std::optional<TonemapKind> kind = tonemap_from_name(name);
  if (!kind) fail_choice(option, name, tonemap_names());
  Tonemap tonemap = make_tonemap(*kind);
  for (const auto& [key, value] : parameters) set_parameter(tonemap, option, key, value);
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

/// Options of a command, as CLI11 gets to know them. Only for the .cpp files that declare arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace candil {

/// Adds options whose words are turned into values by our own functions: the messages are the same with every version
/// of CLI11, and nothing like NaN slips through.
class Arguments {
 public:
  using Setter = std::function<void(const std::string& option, const std::string& text)>;

  explicit Arguments(CLI::App& app) : app_(app) {}

  void group(const std::string& name) { group_ = name; }

  /// Given twice, the last one counts: a script's defaults can be overridden by appending.
  CLI::Option* add(const std::string& name, const std::string& value, const std::string& help, const Setter& set) {
    const auto call = [name, set](const std::string& text) { set(name, text); };
    CLI::Option* const option = app_.add_option_function<std::string>(name, call, help);
    return option->type_name(value)->group(group_)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }

  void add_flag(const std::string& name, const std::string& help, bool& target) {
    app_.add_flag(name, target, help)->group(group_);
  }

 private:
  CLI::App& app_;
  std::string group_;
};

}  // namespace candil

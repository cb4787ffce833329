/// Values out of a TOML document, with messages that name file, line and key. Only for the .cpp that sees the library.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "apps/messages.h"
#include "io/error.h"

namespace candil {

/// A table of the file and its place in it: "test[2]" for the third [[test]].
class TomlTable {
 public:
  TomlTable(const std::filesystem::path& file, std::string place, const toml::table& table)
      : file_(file), place_(std::move(place)), table_(table) {}

  [[noreturn]] void fail(std::string_view key, const toml::node& node, const std::string& message) const {
    const std::string at = place_.empty() || key.empty() ? place_ + std::string(key) : place_ + "." + std::string(key);
    throw InputError(fmt::format("{}:{}", file_.string(), node.source().begin.line), printable(at), printable(message));
  }
  [[noreturn]] void fail(const std::string& message) const { fail("", table_, message); }

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_)
      if (std::ranges::find(keys, key.str()) == keys.end())
        fail(key.str(), node, fmt::format("is not known; known are {}", fmt::join(keys, ", ")));
  }

  /// Nothing when the key is absent.
  const toml::node* find(std::string_view key) const { return table_.get(key); }

  std::optional<TomlTable> table(std::string_view key) const {
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_table()) fail(key, *node, "must be a table");
    return TomlTable(file_, place_.empty() ? std::string(key) : place_ + "." + std::string(key), *node->as_table());
  }

  std::optional<std::string> text(std::string_view key) const {
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    return text_of(key, *node);
  }

  std::optional<std::vector<std::string>> texts(std::string_view key) const {
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_array()) fail(key, *node, "must be a list of texts");
    std::vector<std::string> values;
    for (const toml::node& element : *node->as_array()) values.push_back(text_of(key, element));
    return values;
  }

  std::optional<double> number(std::string_view key, double low, double high) const {
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    const bool is_number = node->is_floating_point() || node->is_integer();
    const double value = is_number ? *node->value<double>() : 0;
    if (!is_number || !(value >= low && value <= high))
      fail(key, *node, fmt::format("must be a number from {:g} to {:g}", low, high));
    return value;
  }

  template <typename Visit>
  void for_each_key(const Visit& visit) const {
    for (const auto& [key, node] : table_) visit(std::string(key.str()), node);
  }

 private:
  std::string text_of(std::string_view key, const toml::node& node) const {
    if (!node.is_string()) fail(key, node, "must be text");
    std::string text = node.as_string()->get();
    if (text.find('\0') != std::string::npos) fail(key, node, "must not hold a zero byte");
    return text;
  }

  const std::filesystem::path& file_;
  std::string place_;
  const toml::table& table_;
};

}  // namespace candil

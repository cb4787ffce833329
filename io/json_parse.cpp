#include "io/json_parse.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "io/error.h"
#include "io/resource.h"

namespace candil {

using nlohmann::json;

nlohmann::json parse_json_with_comments(std::string_view text, const std::string& name) {
  constexpr int deepest = 64;
  std::vector<std::set<std::string>> keys;  // of the objects around the place in hand
  const auto watch = [&](int depth, json::parse_event_t event, const json& value) {
    if (depth > deepest) throw InputError(name, "JSON", "is nested deeper than 64 levels");
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw InputError(name, "JSON", "the key " + quoted_text(value.get<std::string>()) + " is twice in one object");
    return true;
  };
  try {
    constexpr bool allow_exceptions = true, ignore_comments = true;
    return json::parse(text, watch, allow_exceptions, ignore_comments);
  } catch (const json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 7: ..." without its first part, on one line.
    std::string message = error.what();
    if (const std::size_t bracket = message.find("] "); bracket != std::string::npos) message.erase(0, bracket + 2);
    std::ranges::replace_if(
        message, [](unsigned char c) { return c < 0x20; }, '?');
    throw InputError(name, "JSON", message.substr(0, 200));
  }
}

}  // namespace candil

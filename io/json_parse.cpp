#include "io/json_parse.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "io/error.h"
#include "io/resource.h"

namespace candil {
namespace {

using nlohmann::json;

constexpr bool allow_exceptions = true, ignore_comments = true;

/// What a parser meets, nothing of it kept. (Callbacks of json::parse() look at all siblings after each object.) Ends
/// with the first mistake.
class Walk : public nlohmann::json_sax<json> {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

 protected:
  int depth() const { return depth_; }
  virtual bool enter() { return ++depth_ > 0; }

 private:
  bool leave() { return --depth_ >= 0; }
  int depth_ = 0;
};

class KeySearch : public Walk {
 public:
  explicit KeySearch(std::string_view key) : key_(key) {}
  bool key(string_t& key) override {
    is_found_ = depth() == 1 && key == key_;
    return !is_found_;
  }
  bool is_found() const { return is_found_; }

 private:
  std::string_view key_;
  bool is_found_ = false;
};

/// Throws for a key that is twice in one object, and for deep nesting.
class StructureCheck : public Walk {
 public:
  explicit StructureCheck(const std::string& name) : name_(name) {}
  bool start_object(std::size_t count) override {
    keys_.emplace_back();
    return Walk::start_object(count);
  }
  bool end_object() override {
    keys_.pop_back();
    return Walk::end_object();
  }
  bool key(string_t& key) override {
    if (!keys_.back().insert(key).second)
      throw InputError(name_, "JSON", "the key " + quoted_text(key) + " is twice in one object");
    return true;
  }

 private:
  bool enter() override {
    constexpr int deepest = 64;
    if (depth() == deepest) throw InputError(name_, "JSON", "is nested deeper than 64 levels");
    return Walk::enter();
  }

  const std::string& name_;
  std::vector<std::set<std::string>> keys_;  // of the objects around the place in hand
};

void walk(std::string_view text, Walk& walk) {
  constexpr bool is_strict = true;
  json::sax_parse(text, &walk, json::input_format_t::json, is_strict, ignore_comments);
}

}  // namespace

bool has_root_key(std::string_view text, std::string_view key) {
  KeySearch search(key);
  try {
    walk(text, search);
  } catch (const json::exception&) {  // not text at all
  }
  return search.is_found();
}

nlohmann::json parse_json_with_comments(std::string_view text, const std::string& name) {
  try {
    StructureCheck check(name);
    walk(text, check);
    return json::parse(text, nullptr, allow_exceptions, ignore_comments);
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

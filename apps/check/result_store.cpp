#include "apps/check/result_store.h"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/versions.h"
#include "io/atomic_file.h"
#include "io/error.h"

namespace candil {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const char* status_name(TestStatus status) {
  switch (status) {
    case TestStatus::passed:
    case TestStatus::passed_before:
      return "passed";
    case TestStatus::failed:
      return "failed";
    case TestStatus::broken:
      return "error";
    case TestStatus::not_run:
      return "not run";
  }
  return "";
}

/// Everything that a result depends on. Throws InputError when a file cannot be read.
std::string key_of(const SuiteTest& test, const std::string& settings, const std::vector<std::string>& scene_files) {
  std::vector<fs::path> files(scene_files.begin(), scene_files.end());
  files.push_back(test.golden);
  return hash_text(version_line() + "\n" + settings + "\n" + hash_files(files));
}

}  // namespace

ResultStore::ResultStore(const fs::path& folder, bool is_resumed) : file_(folder / "results.json") {
  if (!is_resumed) return;
  std::ifstream stream(file_, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    const Json json = Json::parse(text);
    for (const auto& [name, value] : json.at("tests").items()) {
      Entry entry;
      value.at("key").get_to(entry.key);
      value.at("status").get_to(entry.status);
      value.at("message").get_to(entry.message);
      value.at("seconds").get_to(entry.seconds);
      value.at("files").get_to(entry.files);
      entries_.emplace(name, std::move(entry));
    }
  } catch (const nlohmann::json::exception&) {
    entries_.clear();
  }
}

bool ResultStore::has_passed(const SuiteTest& test, const std::string& settings) const {
  const auto found = entries_.find(test.name);
  if (found == entries_.end() || found->second.status != "passed") return false;
  try {
    return found->second.key == key_of(test, settings, found->second.files);
  } catch (const InputError&) {
    return false;
  }
}

void ResultStore::add(const TestOutcome& outcome, const std::string& settings) {
  Entry entry{"", status_name(outcome.status), outcome.message, outcome.seconds, {}};
  if (outcome.status == TestStatus::passed) {
    for (const fs::path& file : outcome.render->files) entry.files.push_back(file.string());
    entry.key = key_of(*outcome.test, settings, entry.files);
  }
  entries_[outcome.test->name] = std::move(entry);
  Json tests = Json::object();
  for (const auto& [name, value] : entries_)
    tests[name] = {{"status", value.status},
                   {"message", value.message},
                   {"seconds", value.seconds},
                   {"key", value.key},
                   {"files", value.files}};
  const Json json = {{"version", candil_version()}, {"tests", tests}};
  write_file_atomically(file_, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace candil

/// results.json in the output folder: what has passed, so that an interrupted run can go on.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/check/test_outcome.h"

namespace candil {

class ResultStore {
 public:
  /// Begins with what the folder holds if `is_resumed`; a file that cannot be understood counts as none.
  ResultStore(const std::filesystem::path& folder, bool is_resumed);

  /// True when the test has passed with the same options, scene files, golden image and program.
  bool has_passed(const SuiteTest& test, const std::string& settings) const;

  /// Adds a result and writes the file. Throws OutputError.
  void add(const TestOutcome& outcome, const std::string& settings);

 private:
  struct Entry {
    std::string key, status, message;
    double seconds = 0;
    std::vector<std::string> files;  // of the scene
  };

  std::filesystem::path file_;
  std::map<std::string, Entry> entries_;
};

}  // namespace candil

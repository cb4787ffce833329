/// A page for people: all tests of a run, with pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/check/test_outcome.h"

namespace candil {

/// Writes FOLDER/index.html, one self-contained file, and FOLDER/compare/NAME.html for each failure that has pictures
/// (apps/check/failure_page.h). Throws OutputError.
void write_check_report(const std::filesystem::path& folder, const std::string& suite_name,
                        const std::vector<TestOutcome>& outcomes);

}  // namespace candil

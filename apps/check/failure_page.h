/// A page about one failed test: the golden image and the render, to be looked into.
#pragma once

#include <filesystem>
#include <string>

#include "apps/check/test_outcome.h"

namespace candil {

/// Whether there are two images of one size to look at.
bool has_failure_page(const TestOutcome& outcome);

/// The report of `candil compare` (slider, flicker, zoom, exposure), with the numbers of the test; self-contained HTML.
std::string failure_page(const TestOutcome& outcome);

/// Where it is in the folder of the report.
std::filesystem::path failure_page_path(const std::string& test_name);

}  // namespace candil

/// Suites in TOML files; docs/ci.md explains the format.
#pragma once

#include "apps/check/suite.h"

namespace candil {

/// Throws InputError with the line and the key for what is unknown, of the wrong type, out of range or there twice, and
/// for files outside of the suite's folder. Whether scenes exist shows when they are rendered.
Suite read_suite(const std::filesystem::path& file);

}  // namespace candil

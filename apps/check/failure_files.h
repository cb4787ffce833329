/// What a failed test leaves in the output folder: OUTPUT/NAME/.
#pragma once

#include <filesystem>

#include "apps/check/test_outcome.h"

namespace candil {

/// render.exr and golden.exr as they were compared, render.png, golden.png, heat.png (FLIP, black to pale yellow),
/// change.png (change_png()) and command.txt; those that there are. Of a passed test, removes them. Throws OutputError.
void leave_failure_files(const std::filesystem::path& output, const TestOutcome& outcome);

/// The picture as the test wants it shown, 8 bits: an encoded PNG.
std::vector<std::byte> shown_png(const Image& linear, const std::optional<DisplayRequest>& request);
std::vector<std::byte> heat_png(const Image& flip_map);
/// Where `b` is brighter than `a` (of the same size): red, where it is darker: blue, in full from 2 % on; white where
/// they are the same.
std::vector<std::byte> change_png(const Image& a, const Image& b);

}  // namespace candil

/// JSON scenes, written by tests.
#pragma once

#include <string>

#include "io/load_scene.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {

/// Loads the text as "scene.json" in `folder`.
LoadedScene load_json(const TemporaryFolder& folder, const std::string& text);
/// The same in a folder of its own.
LoadedScene load_json(const std::string& text);

/// The message of the InputError that the text gives, without the folder; empty if it loads.
std::string json_error(const TemporaryFolder& folder, const std::string& text);
std::string json_error(const std::string& text);

/// Writes a PNG of grey rows, 0 to 255.
void write_grey_png(const std::filesystem::path& path, int width, int height, const std::vector<int>& values);

}  // namespace candil::test

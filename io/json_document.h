/// A JSON scene with the files that it includes.
#pragma once

#include <filesystem>
#include <vector>

#include "io/json_node.h"

namespace candil {

/// False when the file is JSON with the root member "asset", which marks glTF. True for what is no JSON at all, so that
/// the message is that of a scene file. Throws InputError when it cannot be read.
bool is_json_scene(const std::filesystem::path& path);

/// The file and what it includes, each once: an included file stands before the one that names it, the file itself is
/// last. All are checked against the schema. Throws InputError.
std::vector<JsonFile> read_json_files(const std::filesystem::path& path);

}  // namespace candil

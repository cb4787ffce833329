/// The bytes that the buffer views of a glTF file stand for: out of the file, other files, or compressed.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "io/gltf_container.h"
#include "io/resource.h"

namespace candil {

struct GltfBuffers {
  std::vector<Bytes> owned;  ///< Of other files, data URIs and decompressed views; stays where it is when moved.
  std::vector<std::span<const std::byte>> views;  ///< Of bufferViews[]; into `owned` and the file.
  std::size_t total_bytes = 0;                    ///< Of the buffers that were read.
};

/// Reads the buffers of a file that has passed check_gltf_schema(), each once, and decompresses views of
/// EXT_meshopt_compression and KHR_meshopt_compression, if this program can. A buffer that only such views refer to is
/// not looked for: it is there for readers that cannot. Names of the files read are added to `files`. Throws
/// InputError.
GltfBuffers read_gltf_buffers(const nlohmann::json& root, const GltfContainer& container,
                              const std::filesystem::path& folder, const std::string& name,
                              std::vector<std::filesystem::path>& files);

}  // namespace candil

#include "io/gltf_container.h"

#include <cstdint>
#include <cstring>

#include "io/error.h"

namespace candil {

namespace {

constexpr std::uint32_t magic_gltf = 0x46546C67, chunk_json = 0x4E4F534A, chunk_binary = 0x004E4942;
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

bool is_glb(std::span<const std::byte> file) { return file.size() >= 4 && read_u32(file, 0) == magic_gltf; }

GltfContainer split_gltf(std::span<const std::byte> file, const std::string& name) {
  if (!is_glb(file)) return {as_text(file), {}};
  const auto fail = [&](const std::string& message) { return InputError(name, "GLB", message); };

  if (file.size() < header_bytes) throw fail("the header is truncated");
  const std::uint32_t version = read_u32(file, 4), length = read_u32(file, 8);
  if (version != 2) throw fail("container version " + std::to_string(version) + " is not supported, only 2 is");
  if (length > file.size()) {
    throw fail("the header declares " + std::to_string(length) + " bytes, the file has " + std::to_string(file.size()));
  }
  GltfContainer parts;
  std::size_t offset = header_bytes;
  for (int chunk = 0; offset < length; ++chunk) {
    const std::string which = "chunk " + std::to_string(chunk);
    if (length - offset < chunk_header_bytes) throw fail("the header of " + which + " is truncated");
    const std::uint32_t chunk_length = read_u32(file, offset), type = read_u32(file, offset + 4);
    offset += chunk_header_bytes;
    if (chunk_length > length - offset) throw fail(which + " is longer than the file");
    const std::span<const std::byte> data = file.subspan(offset, chunk_length);
    if ((chunk == 0) != (type == chunk_json)) throw fail("the first chunk, and no other, must be JSON");
    if (type == chunk_binary && chunk != 1) throw fail("only the second chunk may be binary data");
    if (type == chunk_json) parts.json = as_text(data);
    if (type == chunk_binary) parts.binary = data;
    offset += chunk_length;
  }
  if (parts.json.empty()) throw fail("there is no JSON in the file");
  return parts;
}

}  // namespace candil

#include "io/json_internal.h"

namespace candil {

void JsonGeometryFiles::charge(const JsonNode& object, std::size_t bytes) {
  constexpr std::size_t most = std::size_t{8} << 30;
  bytes_ += bytes;
  if (bytes_ > most) object.fail("the files of the scene need more than 8 GiB to be read and when decoded");
}

std::size_t JsonGeometryFiles::charge_file(const JsonNode& object, const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return 0;  // reading it will tell
  charge(object, size);
  return size;
}

std::size_t geometry_bytes(const Mesh& mesh) {
  const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
  return bytes(mesh.positions) + bytes(mesh.triangles) + bytes(mesh.normals) + bytes(mesh.tangents) +
         bytes(mesh.uvs[0]) + bytes(mesh.uvs[1]) + bytes(mesh.colors);
}

}  // namespace candil

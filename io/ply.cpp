#include "io/ply.h"

#include "io/ply_data.h"
#include "io/ply_header.h"
#include "io/ply_mesh.h"
#include "io/resource.h"
#include "io/smooth_normals.h"

namespace candil {

Mesh load_ply(const std::filesystem::path& path, const PlyOptions& options, std::vector<std::string>& warnings) {
  const std::string file = path.string();
  const Bytes content = read_file(path, file, "");
  const std::string_view bytes(reinterpret_cast<const char*>(content.data()), content.size());
  const PlyHeader header = parse_ply_header(bytes, file, warnings);
  Mesh mesh = make_ply_mesh(read_ply_data(header, bytes, file, warnings), file, warnings);
  if (mesh.triangles.empty()) warnings.push_back("the file has no faces, nothing of it is shown");
  if (options.normals == NormalSource::smooth) compute_smooth_normals(mesh, options.crease_angle);
  if (options.normals == NormalSource::flat) mesh.normals.clear();
  return mesh;
}

}  // namespace candil

#include "io/ply_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/color.h"
#include "io/error.h"
#include "io/gltf_geometry.h"
#include "io/polygon.h"
#include "io/smooth_normals.h"

namespace candil {

namespace {

/// Polygons and strips as triangles over the rows of the file.
class TriangleMaker {
 public:
  TriangleMaker(const PlyData& data, const std::string& file, std::vector<std::string>& warnings)
      : data_(data), file_(file), warnings_(warnings), has_uvs_(data.u.empty() && !data.face_uvs.sizes.empty()) {}

  void make(Mesh& mesh) {
    add_faces();
    add_strips();
    if (triangles_.size() >= invalid_id / 3) throw InputError(file_, "", "has more than 1.4 billion triangles");
    mesh.triangles = std::move(triangles_);
    report(small_faces_, "faces with fewer than 3 corners are left out");
    report(rough_faces_, "faces cross themselves or are too intricate, they are shown roughly");
    report(faces_without_uvs_, "faces have a texcoord list that does not suit their corners, (0, 0) is used");
  }

  /// Texture coordinates of corners; empty when the file has none.
  const std::vector<Vec2>& corner_uvs() const { return corner_uvs_; }

 private:
  void report(std::size_t count, const char* what) const {
    if (count > 0) warnings_.push_back("element face: " + std::to_string(count) + " " + what);
  }

  void add_faces() {
    triangles_.reserve(data_.faces.sizes.size());
    std::size_t first = 0, first_uv = 0;
    for (std::size_t face = 0; face < data_.faces.sizes.size(); ++face) {
      const std::uint32_t size = data_.faces.sizes[face];
      if (size == 3 && !has_uvs_) {
        const auto* const v = data_.faces.values.data() + first;
        triangles_.emplace_back(v[0], v[1], v[2]);
      } else {
        add_polygon({data_.faces.values.data() + first, size}, uvs_of(face, first_uv, size));
      }
      first += size;
      if (has_uvs_) first_uv += data_.face_uvs.sizes[face];
    }
  }

  std::span<const float> uvs_of(std::size_t face, std::size_t first, std::uint32_t corner_count) {
    if (!has_uvs_) return {};
    const std::uint32_t size = data_.face_uvs.sizes[face];
    if (size == 2 * std::size_t{corner_count}) return {data_.face_uvs.values.data() + first, size};
    if (size > 0) ++faces_without_uvs_;
    return {};
  }

  void add_polygon(std::span<const std::uint32_t> vertices, std::span<const float> uvs) {
    if (vertices.size() < 3) {
      ++small_faces_;
      return;
    }
    polygon_.clear();
    for (const std::uint32_t v : vertices) polygon_.emplace_back(data_.x[v], data_.y[v], data_.z[v]);
    if (!triangulate_polygon(polygon_, polygon_triangles_, polygon_tests_left_)) ++rough_faces_;
    for (const Triangle& t : polygon_triangles_) {
      triangles_.emplace_back(vertices[t.x], vertices[t.y], vertices[t.z]);
      for (int c = 0; has_uvs_ && c < 3; ++c) {
        const std::size_t at = 2 * std::size_t{t[c]};
        corner_uvs_.push_back(uvs.empty() ? Vec2(0) : Vec2(uvs[at], 1 - uvs[at + 1]));
      }
    }
  }

  void add_strips() {
    std::size_t first = 0;
    std::vector<std::uint32_t> strip;
    for (const std::uint32_t size : data_.strips.sizes) {
      for (std::size_t i = first; i < first + size; ++i) {
        if (data_.strips.values[i] != invalid_id) strip.push_back(data_.strips.values[i]);
        if (data_.strips.values[i] == invalid_id || i + 1 == first + size) add_strip(strip);
      }
      first += size;
    }
  }

  /// Empties the strip.
  void add_strip(std::vector<std::uint32_t>& strip) {
    const std::vector<Triangle> triangles = make_triangles(TriangleMode::strip, strip);
    triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
    if (has_uvs_) corner_uvs_.resize(3 * triangles_.size(), Vec2(0));
    strip.clear();
  }

  const PlyData& data_;
  const std::string& file_;
  std::vector<std::string>& warnings_;
  const bool has_uvs_;
  std::vector<Triangle> triangles_;
  std::vector<Vec2> corner_uvs_;
  std::vector<Vec3> polygon_;
  std::vector<Triangle> polygon_triangles_;
  std::size_t polygon_tests_left_ = std::size_t{1} << 28;  // of a whole file: about a second
  std::size_t small_faces_ = 0, rough_faces_ = 0, faces_without_uvs_ = 0;
};

void set_positions(const PlyData& data, const VertexSelection& used, const std::string& file, Mesh& mesh) {
  mesh.positions.reserve(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t row = used.element(i);
    const Vec3 p(data.x[row], data.y[row], data.z[row]), size = glm::abs(p);
    mesh.positions.push_back(p);
    // Beyond 1e9 m, squared areas overflow single precision.
    if (size.x <= 1e9f && size.y <= 1e9f && size.z <= 1e9f) continue;
    throw InputError(
        file, "element vertex, row " + std::to_string(row),
        is_finite(p) ? "the position is farther than 1e9 m from the origin" : "the position is not finite");
  }
}

void set_normals(const PlyData& data, const VertexSelection& used, Mesh& mesh, std::vector<std::string>& warnings) {
  if (data.normal_x.empty()) return;
  mesh.normals.reserve(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t row = used.element(i);
    mesh.normals.emplace_back(data.normal_x[row], data.normal_y[row], data.normal_z[row]);
  }
  if (repair_normals(mesh))
    warnings.push_back("element vertex: has normals without a direction, those of the triangles are used");
}

void set_uvs(const PlyData& data, const VertexSelection& used, Mesh& mesh) {
  if (data.u.empty()) return;
  mesh.uvs[0].reserve(used.size());
  for (std::size_t i = 0; i < used.size(); ++i)
    mesh.uvs[0].emplace_back(data.u[used.element(i)], 1 - data.v[used.element(i)]);
}

/// An sRGB value of an integer type, a linear one of a floating-point type; not yet clamped.
float linear_of(float value, PlyType type, bool is_alpha) {
  if (!is_integer(type)) return value;
  const float largest = size_of(type) == 2 ? 65535.0f : 255.0f;
  return is_alpha ? value / largest : srgb_to_linear(value / largest);
}

void set_colors(const PlyData& data, const VertexSelection& used, Mesh& mesh, std::vector<std::string>& warnings) {
  if (data.red.empty()) return;
  mesh.colors.reserve(used.size());
  bool is_clamped = false;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t row = used.element(i);
    Vec4 color(linear_of(data.red[row], data.red_type, false), linear_of(data.green[row], data.green_type, false),
               linear_of(data.blue[row], data.blue_type, false),
               data.alpha.empty() ? 1.0f : linear_of(data.alpha[row], data.alpha_type, true));
    for (int c = 0; c < 4; ++c) {
      if (color[c] >= 0 && color[c] <= 1) continue;
      color[c] = color[c] > 1 ? 1.0f : 0.0f;
      is_clamped = true;
    }
    mesh.colors.push_back(color);
  }
  if (is_clamped) warnings.push_back("element vertex: has colours out of range, they are clamped");
}

/// Texture coordinates that belong to corners of faces: vertices are doubled where their faces disagree.
void set_corner_uvs(const std::vector<Vec2>& uvs, Mesh& mesh) {
  std::vector<std::uint32_t> order(uvs.size()), groups(uvs.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto bits = [&](std::uint32_t corner) {
    return std::pair(std::bit_cast<std::uint32_t>(uvs[corner].x), std::bit_cast<std::uint32_t>(uvs[corner].y));
  };
  std::ranges::sort(order, {}, bits);
  for (std::uint32_t i = 0; i < order.size(); ++i)
    groups[order[i]] = i > 0 && bits(order[i]) == bits(order[i - 1]) ? groups[order[i - 1]] : i;
  split_vertices(mesh, groups);
  mesh.uvs[0].resize(mesh.positions.size());
  for (std::uint32_t corner = 0; corner < uvs.size(); ++corner)
    mesh.uvs[0][mesh.triangles[corner / 3][static_cast<int>(corner % 3)]] = uvs[corner];
}

void repair_uvs(Mesh& mesh, std::vector<std::string>& warnings) {
  bool is_repaired = false;
  for (Vec2& uv : mesh.uvs[0]) {
    if (std::abs(uv.x) + std::abs(uv.y) < infinity) continue;
    uv = Vec2(0);
    is_repaired = true;
  }
  if (is_repaired) warnings.push_back("element vertex: has texture coordinates that are not finite, 0 is used");
}

}  // namespace

Mesh make_ply_mesh(const PlyData& data, const std::string& file, std::vector<std::string>& warnings) {
  for (const std::string& what : data.left_out) warnings.push_back(what + " are not supported and not shown");
  Mesh mesh;
  TriangleMaker maker(data, file, warnings);
  maker.make(mesh);
  if (mesh.triangles.empty()) return mesh;
  const VertexSelection used = select_vertices(mesh.triangles, data.vertex_count);
  set_positions(data, used, file, mesh);
  set_normals(data, used, mesh, warnings);
  set_uvs(data, used, mesh);
  set_colors(data, used, mesh, warnings);
  if (!maker.corner_uvs().empty()) set_corner_uvs(maker.corner_uvs(), mesh);
  repair_uvs(mesh, warnings);
  return mesh;
}

}  // namespace candil

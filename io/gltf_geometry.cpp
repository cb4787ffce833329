#include "io/gltf_geometry.h"

#include <algorithm>
#include <cmath>

namespace candil {

namespace {

/// `vertex(i)` is the vertex of corner i. The windings are those of the specification's section 3.7.2.1.
template <class Vertex>
std::vector<Triangle> assemble(TriangleMode mode, std::size_t corner_count, Vertex vertex) {
  const std::size_t count = triangle_count(mode, corner_count);
  std::vector<Triangle> triangles;
  triangles.reserve(count);
  if (mode == TriangleMode::list) {
    for (std::size_t i = 0; i < count; ++i) triangles.push_back({vertex(3 * i), vertex(3 * i + 1), vertex(3 * i + 2)});
    return triangles;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_odd = i % 2 == 1;
    const Triangle t = mode == TriangleMode::strip
                           ? Triangle(vertex(i), vertex(i + (is_odd ? 2 : 1)), vertex(i + (is_odd ? 1 : 2)))
                           : Triangle(vertex(i + 1), vertex(i + 2), vertex(0));
    if (t.x != t.y && t.y != t.z && t.z != t.x) triangles.push_back(t);
  }
  return triangles;
}

/// Unit vector, or zero when `v` has no direction. In double precision: any finite float has a square there.
Vec3 direction_of(Vec3 v) {
  const glm::dvec3 wide(v);
  const double length = glm::length(wide);
  return length > 0 && std::isfinite(length) ? Vec3(wide / length) : Vec3(0);
}

VertexSelection select_few(std::vector<Triangle>& triangles, std::size_t vertex_count) {
  VertexSelection selection{vertex_count, false, {}};
  std::vector<std::uint32_t>& vertices = selection.vertices;
  vertices.reserve(3 * triangles.size());
  for (const Triangle t : triangles) vertices.insert(vertices.end(), {t.x, t.y, t.z});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  vertices.shrink_to_fit();
  const auto new_id = [&](std::uint32_t vertex) {
    return static_cast<std::uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin());
  };
  for (Triangle& t : triangles) t = {new_id(t.x), new_id(t.y), new_id(t.z)};
  return selection;
}

}  // namespace

std::size_t triangle_count(TriangleMode mode, std::size_t corner_count) {
  if (mode == TriangleMode::list) return corner_count / 3;
  return corner_count < 3 ? 0 : corner_count - 2;
}

std::vector<Triangle> make_triangles(TriangleMode mode, const std::vector<std::uint32_t>& indices) {
  return assemble(mode, indices.size(), [&](std::size_t i) { return indices[i]; });
}

std::vector<Triangle> make_triangles(TriangleMode mode, std::size_t vertex_count) {
  return assemble(mode, vertex_count, [](std::size_t i) { return static_cast<std::uint32_t>(i); });
}

VertexSelection select_vertices(std::vector<Triangle>& triangles, std::size_t vertex_count) {
  if (triangles.size() < vertex_count / 8) return select_few(triangles, vertex_count);
  std::vector<std::uint32_t> new_ids(vertex_count, invalid_id);
  for (const Triangle t : triangles) new_ids[t.x] = new_ids[t.y] = new_ids[t.z] = 0;
  VertexSelection selection{vertex_count, true, {}};
  const auto unused = std::count(new_ids.begin(), new_ids.end(), invalid_id);
  if (unused == 0) return selection;
  selection.is_all = false;
  selection.vertices.reserve(vertex_count - static_cast<std::size_t>(unused));
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    if (new_ids[v] == invalid_id) continue;
    new_ids[v] = static_cast<std::uint32_t>(selection.vertices.size());
    selection.vertices.push_back(v);
  }
  for (Triangle& t : triangles) t = {new_ids[t.x], new_ids[t.y], new_ids[t.z]};
  return selection;
}

bool repair_normals(Mesh& mesh) {
  bool has_invalid = false;
  for (Vec3& normal : mesh.normals) {
    const float squared = glm::dot(normal, normal);
    const bool is_usual = squared > 1e-12f && squared < 1e12f;
    normal = is_usual ? normal / std::sqrt(squared) : direction_of(normal);
    has_invalid = has_invalid || is_black(normal);
  }
  if (!has_invalid) return false;
  for (const Triangle t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) {
      Vec3& normal = mesh.normals[t[c]];
      if (!is_black(normal)) continue;
      const glm::dvec3 origin(mesh.positions[t.x]);
      normal = direction_of(
          Vec3(glm::cross(glm::dvec3(mesh.positions[t.y]) - origin, glm::dvec3(mesh.positions[t.z]) - origin)));
    }
  }
  for (Vec3& normal : mesh.normals) {  // of vertices with empty triangles only
    if (is_black(normal)) normal = Vec3(0, 1, 0);
  }
  return true;
}

bool repair_tangents(Mesh& mesh) {
  bool has_invalid = false;
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    Vec4& tangent = mesh.tangents[i];
    Vec3 direction = direction_of(Vec3(tangent));
    if (is_black(direction)) {
      has_invalid = true;
      const Vec3 normal = mesh.normals[i];
      direction = direction_of(glm::cross(std::abs(normal.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0), normal));
    }
    tangent = Vec4(direction, tangent.w < 0 ? -1 : 1);
  }
  return has_invalid;
}

}  // namespace candil

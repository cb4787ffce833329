#include "io/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace candil {

namespace {

/// For every vertex the first one at the same position.
std::vector<std::uint32_t> merge_positions(const std::vector<Vec3>& positions) {
  const auto key = [&](std::uint32_t v) {
    const Vec3 p = positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto key_a = key(a), key_b = key(b);
    return key_a < key_b || (key_a == key_b && a < b);
  });
  std::vector<std::uint32_t> points(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key(order[i]) == key(order[i - 1]);
    points[order[i]] = is_same ? points[order[i - 1]] : order[i];
  }
  return points;
}

Vec3 face_normal(const Mesh& mesh, const Triangle& t) {
  const glm::dvec3 origin(mesh.positions[t.x]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(mesh.positions[t.y]) - origin, glm::dvec3(mesh.positions[t.z]) - origin);
  const double length = glm::length(normal);
  return length > 0 ? Vec3(normal / length) : Vec3(0);
}

/// Sets of corners (union-find with path halving).
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  std::uint32_t find(std::uint32_t corner) {
    while (parents_[corner] != corner) corner = parents_[corner] = parents_[parents_[corner]];
    return corner;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

std::uint32_t next_corner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

class Smoother {
 public:
  Smoother(Mesh& mesh, float crease_angle)
      : mesh_(mesh),
        // The slack keeps rounding from breaking up planes; it is 0.08 degrees at an angle of zero.
        least_cosine_(crease_angle >= pi ? -infinity : std::cos(crease_angle) - 1e-6f),
        points_(merge_positions(mesh.positions)),
        sets_(3 * mesh.triangles.size()) {}

  void run() {
    mesh_.normals.clear();
    for (const Triangle& t : mesh_.triangles) face_normals_.push_back(is_sliver(t) ? Vec3(0) : face_normal(mesh_, t));
    join_neighbours();
    const std::vector<std::uint32_t> groups = group_corners();
    const std::vector<Vec3> sums = sum_groups(groups);
    split_vertices(mesh_, groups);
    mesh_.normals.resize(mesh_.positions.size(), Vec3(0, 1, 0));  // of vertices with empty triangles only
    for (std::uint32_t corner = 0; corner < groups.size(); ++corner) {
      const Vec3 sum = sums[groups[corner]], face = face_normals_[corner / 3];
      const float length = glm::length(sum);
      // Faces that cancel each other, such as the two sides of a sheet, leave no direction.
      if (length > 1e-4f) {
        mesh_.normals[vertex(corner)] = sum / length;
      } else if (!is_black(face)) {
        mesh_.normals[vertex(corner)] = face;
      }
    }
  }

 private:
  std::uint32_t vertex(std::uint32_t corner) const { return mesh_.triangles[corner / 3][static_cast<int>(corner % 3)]; }
  std::uint32_t point(std::uint32_t corner) const { return points_[vertex(corner)]; }
  bool is_sliver(const Triangle& t) const {
    return points_[t.x] == points_[t.y] || points_[t.y] == points_[t.z] || points_[t.z] == points_[t.x];
  }
  bool is_empty(std::uint32_t corner) const { return is_black(face_normals_[corner / 3]); }

  /// Edges, named by the corner that they leave, in one row for each lower end.
  void join_neighbours() {
    struct Edge {
      std::uint32_t other_end, corner;
      auto operator<=>(const Edge&) const = default;
    };
    const auto corner_count = static_cast<std::uint32_t>(3 * mesh_.triangles.size());
    const auto low_end = [&](std::uint32_t corner) { return std::min(point(corner), point(next_corner(corner))); };
    std::vector<std::uint32_t> ends(points_.size() + 1, 0);
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      if (!is_empty(corner)) ++ends[low_end(corner) + 1];
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Edge> edges(ends.back());
    std::vector<std::uint32_t> places = ends;
    for (std::uint32_t corner = 0; corner < corner_count; ++corner)
      if (!is_empty(corner))
        edges[places[low_end(corner)]++] = {std::max(point(corner), point(next_corner(corner))), corner};
    for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
      std::sort(edges.begin() + ends[p], edges.begin() + ends[p + 1]);
      for (std::uint32_t e = ends[p]; e + 1 < ends[p + 1]; ++e)
        if (edges[e].other_end == edges[e + 1].other_end) join(edges[e].corner, edges[e + 1].corner);
    }
  }

  /// Joins the corners at both ends of an edge, unless it is sharp.
  void join(std::uint32_t a, std::uint32_t b) {
    if (glm::dot(face_normals_[a / 3], face_normals_[b / 3]) < least_cosine_) return;
    const bool is_same_way = point(a) == point(b);
    sets_.unite(a, is_same_way ? b : next_corner(b));
    sets_.unite(next_corner(a), is_same_way ? next_corner(b) : b);
  }

  /// Corners of empty triangles go along with any other of their vertex.
  std::vector<std::uint32_t> group_corners() {
    std::vector<std::uint32_t> groups(3 * mesh_.triangles.size()), of_vertex(mesh_.positions.size(), invalid_id);
    for (std::uint32_t corner = 0; corner < groups.size(); ++corner) {
      groups[corner] = sets_.find(corner);
      if (!is_empty(corner)) of_vertex[vertex(corner)] = groups[corner];
    }
    for (std::uint32_t corner = 0; corner < groups.size(); ++corner) {
      if (!is_empty(corner)) continue;
      std::uint32_t& group = of_vertex[vertex(corner)];
      if (group == invalid_id) group = groups[corner];
      groups[corner] = group;
    }
    return groups;
  }

  std::vector<Vec3> sum_groups(const std::vector<std::uint32_t>& groups) const {
    std::vector<Vec3> sums(groups.size(), Vec3(0));
    for (std::uint32_t corner = 0; corner < groups.size(); ++corner) {
      const std::uint32_t next = next_corner(corner);
      const Vec3 p = mesh_.positions[vertex(corner)];
      const glm::dvec3 to_next(mesh_.positions[vertex(next)] - p),
          to_last(mesh_.positions[vertex(next_corner(next))] - p);
      const double angle = std::atan2(glm::length(glm::cross(to_next, to_last)), glm::dot(to_next, to_last));
      sums[groups[corner]] += static_cast<float>(angle) * face_normals_[corner / 3];
    }
    return sums;
  }

  Mesh& mesh_;
  const float least_cosine_;
  const std::vector<std::uint32_t> points_;
  CornerSets sets_;
  std::vector<Vec3> face_normals_;  ///< Zero for triangles without area.
};

template <typename Value>
void append_copy(std::vector<Value>& values, std::uint32_t i) {
  if (!values.empty()) values.push_back(Value(values[i]));
}

}  // namespace

void split_vertices(Mesh& mesh, std::span<const std::uint32_t> groups) {
  struct Moved {
    std::uint32_t vertex, group, corner;
    auto operator<=>(const Moved&) const = default;
  };
  std::vector<std::uint32_t> group_of_vertex(mesh.positions.size(), invalid_id);
  std::vector<Moved> moved;
  for (std::uint32_t corner = 0; corner < groups.size(); ++corner) {
    const std::uint32_t vertex = mesh.triangles[corner / 3][static_cast<int>(corner % 3)];
    if (group_of_vertex[vertex] == invalid_id) group_of_vertex[vertex] = groups[corner];
    if (group_of_vertex[vertex] != groups[corner]) moved.push_back({vertex, groups[corner], corner});
  }
  std::ranges::sort(moved);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const auto [vertex, group, corner] = moved[i];
    if (i == 0 || vertex != moved[i - 1].vertex || group != moved[i - 1].group) {
      append_copy(mesh.positions, vertex);
      append_copy(mesh.normals, vertex);
      append_copy(mesh.tangents, vertex);
      for (std::vector<Vec2>& uvs : mesh.uvs) append_copy(uvs, vertex);
      append_copy(mesh.colors, vertex);
    }
    mesh.triangles[corner / 3][static_cast<int>(corner % 3)] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
}

void compute_smooth_normals(Mesh& mesh, float crease_angle) { Smoother(mesh, crease_angle).run(); }

}  // namespace candil

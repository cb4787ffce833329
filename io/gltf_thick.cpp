#include "io/gltf_thick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace candil {

namespace {

constexpr std::uint32_t tube_sides = 16;

/// Triangles with corners on a sphere; the mean of its silhouettes is that of the unit sphere.
struct Ball {
  std::vector<Vec3> directions;
  std::vector<Triangle> triangles;
  float radius = 1;  ///< Of the corners.
};

Ball make_icosahedron() {
  const float golden = 0.5f * (1 + std::sqrt(5.0f));
  Ball ball;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float long_side : {golden, -golden}) {
      for (const float short_side : {1.0f, -1.0f}) {
        Vec3 corner(0);
        corner[axis] = long_side, corner[(axis + 1) % 3] = short_side;
        ball.directions.push_back(glm::normalize(corner));
      }
    }
  }
  // The faces are all triples of corners that are neighbours: their directions have a cosine of 1 / sqrt 5.
  const auto is_edge = [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(ball.directions[a], ball.directions[b]) > 0.4f;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(c, a)) continue;
        const auto& d = ball.directions;
        const bool is_outwards = glm::dot(glm::cross(d[b] - d[a], d[c] - d[a]), d[a]) > 0;
        ball.triangles.push_back(is_outwards ? Triangle(a, b, c) : Triangle(a, c, b));
      }
    }
  }
  return ball;
}

void subdivide(Ball& ball) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(ball.directions.size());
    const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), next);
    if (is_new) ball.directions.push_back(glm::normalize(ball.directions[a] + ball.directions[b]));
    return entry->second;
  };
  std::vector<Triangle> finer;
  for (const Triangle t : ball.triangles) {
    const std::uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
    finer.insert(finer.end(),
                 {Triangle(t.x, xy, zx), Triangle(t.y, yz, xy), Triangle(t.z, zx, yz), Triangle(xy, yz, zx)});
  }
  ball.triangles = std::move(finer);
}

Ball make_ball(int subdivisions) {
  Ball ball = make_icosahedron();
  for (int i = 0; i < subdivisions; ++i) subdivide(ball);
  // Cauchy: the mean silhouette of a convex body is a quarter of its surface.
  double area = 0;
  for (const Triangle t : ball.triangles) {
    const auto& d = ball.directions;
    area += 0.5 * static_cast<double>(glm::length(glm::cross(d[t.y] - d[t.x], d[t.z] - d[t.x])));
  }
  ball.radius = static_cast<float>(std::sqrt(4 * static_cast<double>(pi) / area));
  return ball;
}

class Thickener {
 public:
  Thickener(Mesh& skeleton, float radius, const Mat3& to_world, ThickDetail detail)
      : skeleton_(skeleton),
        radius_(radius),
        to_world_(to_world),
        from_world_(glm::inverse(glm::dmat3(to_world))),
        is_mirrored_(glm::determinant(to_world) < 0),
        ball_(make_ball(detail.subdivisions)) {
    mesh_.positions.reserve(detail.vertices);
    mesh_.normals.reserve(detail.vertices);
    mesh_.triangles.reserve(detail.triangles);
  }

  Mesh run() {
    for (std::uint32_t v = 0; v < skeleton_.positions.size(); ++v) add_ball(v);
    for (const Triangle segment : skeleton_.triangles) {
      if (segment.x != segment.y) add_tube(segment.x, segment.y);
    }
    return std::move(mesh_);
  }

 private:
  /// A vertex at `distance` from one of the skeleton's in a unit direction of the world.
  void add_vertex(std::uint32_t from, Vec3 direction, float distance) {
    mesh_.positions.push_back(skeleton_.positions[from] + Vec3(from_world_ * glm::dvec3(distance * direction)));
    // The world's normal is L^-T of ours.
    mesh_.normals.push_back(glm::normalize(glm::transpose(to_world_) * direction));
    for (std::size_t set = 0; set < 2; ++set) {
      if (!skeleton_.uvs[set].empty()) mesh_.uvs[set].push_back(skeleton_.uvs[set][from]);
    }
    if (!skeleton_.colors.empty()) mesh_.colors.push_back(skeleton_.colors[from]);
  }

  /// Given counter-clockwise as the world sees it; a mirroring transform will turn it around.
  void add_triangle(Triangle t) { mesh_.triangles.push_back(is_mirrored_ ? Triangle(t.x, t.z, t.y) : t); }

  std::uint32_t next_vertex() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }

  void add_ball(std::uint32_t vertex) {
    const std::uint32_t first = next_vertex();
    for (const Vec3 direction : ball_.directions) add_vertex(vertex, direction, radius_ * ball_.radius);
    for (const Triangle t : ball_.triangles) add_triangle(t + first);
  }

  void add_tube(std::uint32_t a, std::uint32_t b) {
    const Vec3 along = to_world_ * (skeleton_.positions[b] - skeleton_.positions[a]);
    const float length = glm::length(along);
    if (!(length > 0 && length < infinity)) return;
    const Vec3 w = along / length;
    const Vec3 u = glm::normalize(glm::cross(std::abs(w.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0), w));
    const Vec3 v = glm::cross(w, u);
    constexpr float step = 2 * pi / static_cast<float>(tube_sides);
    // Cauchy again: the mean width of a convex polygon is its perimeter over pi.
    const float corner_radius = radius_ * (step / 2) / std::sin(step / 2);
    const std::uint32_t first = next_vertex();
    for (std::uint32_t side = 0; side < tube_sides; ++side) {
      const float angle = step * static_cast<float>(side);
      const Vec3 direction = std::cos(angle) * u + std::sin(angle) * v;
      add_vertex(a, direction, corner_radius);
      add_vertex(b, direction, corner_radius);
    }
    for (std::uint32_t side = 0; side < tube_sides; ++side) {
      const std::uint32_t here = first + 2 * side, next = first + 2 * ((side + 1) % tube_sides);
      add_triangle({here, next, next + 1});
      add_triangle({here, next + 1, here + 1});
    }
  }

  const Mesh& skeleton_;
  const float radius_;
  const Mat3 to_world_;
  const glm::dmat3 from_world_;
  const bool is_mirrored_;
  const Ball ball_;
  Mesh mesh_;
};

}  // namespace

std::size_t thin_count(ThinMode mode, std::size_t corner_count) {
  switch (mode) {
    case ThinMode::points:
      return corner_count;
    case ThinMode::lines:
      return corner_count / 2;
    case ThinMode::line_strip:
      return corner_count < 2 ? 0 : corner_count - 1;
    case ThinMode::line_loop:
      return corner_count < 3 ? corner_count / 2 : corner_count;
  }
  return 0;
}

std::vector<Triangle> make_thin(ThinMode mode, const std::vector<std::uint32_t>& corners) {
  std::vector<Triangle> elements(thin_count(mode, corners.size()));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::size_t first = mode == ThinMode::lines ? 2 * i : i;
    const std::size_t second = mode == ThinMode::points ? first : (first + 1) % corners.size();
    elements[i] = {corners[first], corners[second], corners[second]};
  }
  return elements;
}

ThickDetail choose_thick_detail(std::size_t vertex_count, std::size_t segment_count) {
  constexpr std::size_t most_triangles = 2'000'000;
  ThickDetail detail;
  for (int subdivisions = 3; subdivisions >= 1; --subdivisions) {
    const std::size_t faces = std::size_t{20} << (2 * subdivisions);
    detail.subdivisions = subdivisions;
    detail.triangles = vertex_count * faces + segment_count * 2 * tube_sides;
    detail.vertices = vertex_count * (faces / 2 + 2) + segment_count * 2 * tube_sides;
    if (detail.triangles <= most_triangles) break;
  }
  return detail;
}

void make_thick(Mesh& mesh, float radius, const Mat3& to_world, ThickDetail detail) {
  Mesh thick = Thickener(mesh, radius, to_world, detail).run();
  thick.name = std::move(mesh.name);
  thick.material = mesh.material;
  mesh = std::move(thick);
}

}  // namespace candil

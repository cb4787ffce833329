#include "io/tangents.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace candil {

namespace {

/// Position, normal and uv of a vertex: corners that agree in all bits are one vertex to MikkTSpace.
using VertexKey = std::array<float, 8>;

std::size_t hash_of(const VertexKey& key) {
  std::uint64_t hash = 0x9E3779B97F4A7C15u;
  for (const float value : key) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 0xD6E8FEB86659FD93u;
    hash ^= hash >> 32;
  }
  return hash;
}

/// The uv parameterisation of one triangle.
struct TriangleFrame {
  Vec3 direction_u{0.0f};  ///< Unit, in the plane of the triangle; zero if the triangle or its uvs are degenerate.
  bool is_mirrored = false;

  bool is_degenerate() const { return is_black(direction_u); }
};

Vec3 unit_or_zero(Vec3 v) {
  const float length = glm::length(v);
  return length > 0 && length < infinity ? v / length : Vec3(0);
}

Vec3 any_perpendicular(Vec3 n) {
  const Vec3 axis = std::abs(n.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 tangent = unit_or_zero(axis - n * glm::dot(n, axis));
  return is_black(tangent) ? Vec3(1, 0, 0) : tangent;
}

TriangleFrame make_frame(const Mesh& mesh, const std::vector<Vec2>& uvs, Triangle t) {
  const Vec3 edge1 = mesh.positions[t.y] - mesh.positions[t.x], edge2 = mesh.positions[t.z] - mesh.positions[t.x];
  // v points up, as in the original.
  const Vec2 uv1 = (uvs[t.y] - uvs[t.x]) * Vec2(1, -1), uv2 = (uvs[t.z] - uvs[t.x]) * Vec2(1, -1);
  const float area = uv1.x * uv2.y - uv1.y * uv2.x;
  TriangleFrame frame;
  frame.is_mirrored = area < 0;
  if (area != 0) frame.direction_u = unit_or_zero((uv2.y * edge1 - uv1.y * edge2) * (area < 0 ? -1.0f : 1.0f));
  return frame;
}

/// The angle of a triangle at `at`, seen along `normal`; `a` and `b` are the other two corners.
float corner_angle(Vec3 at, Vec3 a, Vec3 b, Vec3 normal) {
  const auto flat = [&](Vec3 edge) { return unit_or_zero(edge - normal * glm::dot(normal, edge)); };
  return std::acos(glm::clamp(glm::dot(flat(a - at), flat(b - at)), -1.0f, 1.0f));
}

/// The two tangents that a welded vertex can have: of triangles with mirrored uvs and of those without.
struct VertexTangents {
  std::array<Vec3, 2> sum{Vec3(0), Vec3(0)};  ///< By TriangleFrame::is_mirrored.
};

class TangentGenerator {
 public:
  TangentGenerator(Mesh& mesh, std::vector<Vec2> uvs)
      : mesh_(mesh), uvs_(std::move(uvs)), is_flat_(mesh.normals.empty()) {}

  void run() {
    if (is_flat_) separate_triangles();
    weld_vertices();
    accumulate();
    assign();
  }

 private:
  Vec3 flat_normal(Triangle t) const {
    return unit_or_zero(
        glm::cross(mesh_.positions[t.y] - mesh_.positions[t.x], mesh_.positions[t.z] - mesh_.positions[t.x]));
  }

  VertexKey key_of(std::uint32_t vertex, Vec3 normal) const {
    const Vec3 p = mesh_.positions[vertex];
    const Vec2 uv = uvs_[vertex];
    // Adding zero turns -0 into 0.
    return {p.x + 0.0f,      p.y + 0.0f,      p.z + 0.0f,  normal.x + 0.0f,
            normal.y + 0.0f, normal.z + 0.0f, uv.x + 0.0f, uv.y + 0.0f};
  }

  /// Flat triangles share no tangents: each gets vertices of its own.
  void separate_triangles() {
    const auto expand = [&](auto& attribute) {
      if (attribute.empty()) return;
      std::decay_t<decltype(attribute)> expanded;
      expanded.reserve(3 * mesh_.triangles.size());
      for (const Triangle t : mesh_.triangles) {
        for (int c = 0; c < 3; ++c) expanded.push_back(attribute[t[c]]);
      }
      attribute = std::move(expanded);
    };
    expand(mesh_.positions);
    expand(uvs_);
    expand(mesh_.uvs[0]);
    expand(mesh_.uvs[1]);
    expand(mesh_.colors);
    std::uint32_t vertex = 0;
    for (Triangle& t : mesh_.triangles) t = {vertex, vertex + 1, vertex + 2}, vertex += 3;
  }

  /// Gives every vertex the id of the welded vertex that it is one copy of.
  void weld_vertices() {
    const std::size_t count = mesh_.positions.size();
    welded_.resize(count);
    // A hash table with linear probing, at most half full; its slots name the first vertex of each kind.
    const std::size_t mask = std::bit_ceil(2 * count + 1) - 1;
    std::vector<std::uint32_t> slots(mask + 1, invalid_id);
    for (std::uint32_t v = 0; v < count; ++v) {
      const Vec3 normal = is_flat_ ? flat_normal(mesh_.triangles[v / 3]) : mesh_.normals[v];
      const VertexKey key = key_of(v, normal);
      std::size_t slot = hash_of(key) & mask;
      while (slots[slot] != invalid_id && key_of(slots[slot], normals_[welded_[slots[slot]]]) != key) {
        slot = (slot + 1) & mask;
      }
      if (slots[slot] == invalid_id) {
        slots[slot] = v;
        welded_[v] = static_cast<std::uint32_t>(normals_.size());
        normals_.push_back(normal);
      } else {
        welded_[v] = welded_[slots[slot]];
      }
    }
  }

  void accumulate() {
    tangents_.resize(normals_.size());
    is_mirrored_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Triangle triangle = mesh_.triangles[t];
      const TriangleFrame frame = make_frame(mesh_, uvs_, triangle);
      is_mirrored_[t] = frame.is_mirrored;
      if (frame.is_degenerate()) continue;
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t vertex = welded_[triangle[c]];
        const Vec3 normal = normals_[vertex];
        const Vec3 at = mesh_.positions[triangle[c]];
        const float angle =
            corner_angle(at, mesh_.positions[triangle[(c + 1) % 3]], mesh_.positions[triangle[(c + 2) % 3]], normal);
        const Vec3 direction = unit_or_zero(frame.direction_u - normal * glm::dot(normal, frame.direction_u));
        tangents_[vertex].sum[frame.is_mirrored] += angle * direction;
      }
    }
  }

  /// A triangle without directions of its own takes those of its neighbours, whichever orientation they have.
  Vec4 corner_tangent(std::uint32_t vertex, bool is_mirrored) const {
    const VertexTangents& both = tangents_[vertex];
    if (is_black(both.sum[is_mirrored]) && !is_black(both.sum[!is_mirrored])) is_mirrored = !is_mirrored;
    const Vec3 tangent = unit_or_zero(both.sum[is_mirrored]);
    if (is_black(tangent)) return Vec4(any_perpendicular(normals_[vertex]), 1);
    return Vec4(tangent, is_mirrored ? -1 : 1);
  }

  /// Writes the tangents to the mesh's vertices; one that gets a second, different tangent is duplicated (there are two
  /// orientations, hence one copy at most).
  void assign() {
    const std::size_t vertex_count = mesh_.positions.size();
    mesh_.tangents.assign(vertex_count, Vec4(0));
    std::vector<std::uint32_t> next_copy(vertex_count, invalid_id);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        std::uint32_t& vertex = mesh_.triangles[t][c];
        vertex = vertex_with_tangent(vertex, corner_tangent(welded_[vertex], is_mirrored_[t]), next_copy);
      }
    }
    for (Vec4& tangent : mesh_.tangents) {  // of vertices without a triangle
      if (tangent.w == 0) tangent = Vec4(1, 0, 0, 1);
    }
  }

  std::uint32_t vertex_with_tangent(std::uint32_t vertex, Vec4 tangent, std::vector<std::uint32_t>& next_copy) {
    while (true) {
      if (mesh_.tangents[vertex].w == 0) mesh_.tangents[vertex] = tangent;
      if (mesh_.tangents[vertex] == tangent) return vertex;
      if (next_copy[vertex] == invalid_id) break;
      vertex = next_copy[vertex];
    }
    const auto copy = static_cast<std::uint32_t>(mesh_.positions.size());
    next_copy[vertex] = copy;
    next_copy.push_back(invalid_id);
    mesh_.tangents.push_back(tangent);
    const auto duplicate = [&](auto& attribute) {
      if (attribute.empty()) return;
      const auto value = attribute[vertex];
      attribute.push_back(value);
    };
    duplicate(mesh_.positions);
    duplicate(mesh_.normals);
    duplicate(mesh_.uvs[0]);
    duplicate(mesh_.uvs[1]);
    duplicate(mesh_.colors);
    return copy;
  }

  Mesh& mesh_;
  std::vector<Vec2> uvs_;  // per vertex of the mesh as it was
  const bool is_flat_;
  std::vector<std::uint32_t> welded_;  // per vertex of the mesh as it was
  std::vector<Vec3> normals_;          // of welded vertices
  std::vector<VertexTangents> tangents_;
  std::vector<bool> is_mirrored_;
};

}  // namespace

void generate_tangents(Mesh& mesh, int uv_set) {
  TangentGenerator(mesh, mesh.uvs[static_cast<std::size_t>(uv_set)]).run();
}

void generate_tangents(Mesh& mesh, const TextureSlot& slot) {
  std::vector<Vec2> looked_up = mesh.uvs[slot.uv_set];
  for (Vec2& uv : looked_up) {
    uv = Vec2(glm::dot(slot.row_u, Vec3(uv, 1)), glm::dot(slot.row_v, Vec3(uv, 1)));
    if (!(std::abs(uv.x) + std::abs(uv.y) < infinity)) uv = Vec2(0);
  }
  TangentGenerator(mesh, std::move(looked_up)).run();
}

}  // namespace candil

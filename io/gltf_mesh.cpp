#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "io/gltf_accessor.h"
#include "io/gltf_deform.h"
#include "io/gltf_geometry.h"
#include "io/gltf_internal.h"
#include "io/gltf_thick.h"
#include "io/gltf_tinygltf.h"
#include "io/tangents.h"

namespace candil {

namespace {

constexpr std::size_t bytes_per_vertex = 60, bytes_per_triangle = 120;
constexpr std::size_t bytes_per_displacement = 12, bytes_per_influence = 32;

/// Nothing for triangles of any kind.
std::optional<ThinMode> thin_mode_of(const tinygltf::Primitive& primitive) {
  switch (primitive.mode) {
    case TINYGLTF_MODE_POINTS:
      return ThinMode::points;
    case TINYGLTF_MODE_LINE:
      return ThinMode::lines;
    case TINYGLTF_MODE_LINE_STRIP:
      return ThinMode::line_strip;
    case TINYGLTF_MODE_LINE_LOOP:
      return ThinMode::line_loop;
    default:
      return {};
  }
}

/// Reads one primitive; the vertices it does not use are left out.
class PrimitiveReader {
 public:
  PrimitiveReader(const GltfDocument& document, const tinygltf::Primitive& primitive, std::string place,
                  Warnings& warnings)
      : document_(document), primitive_(primitive), place_(std::move(place)), warnings_(warnings) {}

  /// Points and segments of lines, however they will be shown.
  ThinCounts thin_counts() const {
    const std::optional<ThinMode> mode = thin_mode_of(primitive_);
    const int positions = attribute("POSITION");
    if (!mode || positions < 0) return {};
    const std::size_t count = thin_count(*mode, corner_count(accessor_count(document_, positions)));
    return *mode == ThinMode::points ? ThinCounts{count, 0} : ThinCounts{0, count};
  }

  /// Triangles, vertices and all attributes but tangents, as in the file; nothing (and a warning) if there is nothing
  /// to show. `is_thin`: points and lines, as make_thin() has them. `bytes_left` is what the file may still expand to.
  std::optional<Mesh> read(bool is_thin, std::size_t& bytes_left) {
    const std::optional<TriangleMode> mode = is_thin ? TriangleMode::list : triangle_mode();
    const int positions = attribute("POSITION");
    if (!mode || positions < 0) {
      if (mode) warnings_.add(place_, "has no POSITION, it is not shown");
      return {};
    }
    selection_.accessor_count = accessor_count(document_, positions);
    if (selection_.accessor_count >= invalid_id) document_.fail(place_, "has too many vertices");
    Mesh mesh;
    mesh.triangles = is_thin ? assemble_thin(bytes_left) : assemble_triangles(*mode, bytes_left);
    if (mesh.triangles.empty()) {
      warnings_.add(place_, is_thin ? "has no points or lines" : "has no triangles");
      return {};
    }
    selection_ = select_vertices(mesh.triangles, selection_.accessor_count);
    charge(selection_.size() * bytes_per_vertex, bytes_left);
    mesh.positions = read_vec3(document_, positions, selection_, attribute_place("POSITION"));
    if (const int index = attribute("NORMAL"); index >= 0 && !is_thin) {
      mesh.normals = read_vec3(document_, index, selection_, attribute_place("NORMAL"));
    }
    for (std::size_t set = 0; set < mesh.uvs.size(); ++set) {
      const std::string semantic = "TEXCOORD_" + std::to_string(set);
      const int index = attribute(semantic);
      if (index >= 0) mesh.uvs[set] = read_vec2(document_, index, selection_, attribute_place(semantic));
    }
    if (const int index = attribute("COLOR_0"); index >= 0) {
      mesh.colors = read_color(document_, index, selection_, attribute_place("COLOR_0"));
    }
    check_morph_targets(source());
    return mesh;
  }

  /// The tangents of the file; the specification wants them ignored where normals are absent.
  void read_tangents(Mesh& mesh) const {
    const int index = attribute("TANGENT");
    if (index < 0 || mesh.normals.empty()) return;
    mesh.tangents = read_vec4(document_, index, selection_, attribute_place("TANGENT"));
  }

  /// The vertices that read() chose.
  const VertexSelection& selection() const { return selection_; }

  /// Pays for one more copy of a mesh that was read before, with these vertices.
  void reuse(const Mesh& mesh, const VertexSelection& selection, std::size_t& bytes_left) {
    selection_ = selection;
    charge(mesh.triangles.size() * bytes_per_triangle + mesh.positions.size() * bytes_per_vertex, bytes_left);
  }

  /// Makes points and lines of this radius in metres out of thin ones.
  void thicken(float radius, const Mat3& to_world, Mesh& mesh, std::size_t& bytes_left) const {
    const std::size_t segments = *thin_mode_of(primitive_) == ThinMode::points ? 0 : mesh.triangles.size();
    const ThickDetail detail = choose_thick_detail(mesh.positions.size(), segments);
    charge(detail.triangles * bytes_per_triangle + detail.vertices * bytes_per_vertex, bytes_left);
    if (detail.vertices >= invalid_id || detail.triangles >= invalid_id)
      document_.fail(place_, "has too many vertices");
    make_thick(mesh, radius, to_world, detail);
  }

  void bend(const Deformation& deformation, Mesh& mesh, std::size_t& bytes_left) const {
    // What is read for it counts as well: a file must not ask for years of work in a few lines.
    for (const float weight : deformation.weights) {
      if (weight != 0) charge(selection_.size() * bytes_per_displacement, bytes_left);
    }
    for (const auto& [semantic, accessor] : primitive_.attributes) {
      if (semantic.starts_with("JOINTS_")) charge(selection_.size() * bytes_per_influence, bytes_left);
    }
    deform(source(), deformation, mesh, warnings_);
  }

  /// Makes the attributes such that renderers can rely on them.
  void repair(Mesh& mesh) const {
    check_positions(mesh);
    if (repair_normals(mesh)) {
      warnings_.add(attribute_place("NORMAL"), "has normals without a direction, those of the triangles are used");
    }
    repair_uvs(mesh);
    clamp_colors(mesh);
    if (repair_tangents(mesh)) warnings_.add(attribute_place("TANGENT"), "has invalid tangents, any other are used");
  }

 private:
  PrimitiveSource source() const { return {document_, primitive_, place_, selection_}; }

  int attribute(const std::string& semantic) const {
    const auto found = primitive_.attributes.find(semantic);
    return found == primitive_.attributes.end() ? -1 : found->second;
  }

  std::string attribute_place(const std::string& semantic) const { return place_ + ".attributes." + semantic; }

  void charge(std::size_t bytes, std::size_t& bytes_left) const {
    if (bytes > bytes_left) document_.fail(place_, "expands to far more geometry than the file has bytes for");
    bytes_left -= bytes;
  }

  std::optional<TriangleMode> triangle_mode() const {
    switch (primitive_.mode) {
      case -1:
      case TINYGLTF_MODE_TRIANGLES:
        return TriangleMode::list;
      case TINYGLTF_MODE_TRIANGLE_STRIP:
        return TriangleMode::strip;
      case TINYGLTF_MODE_TRIANGLE_FAN:
        return TriangleMode::fan;
      case TINYGLTF_MODE_POINTS:
        warnings_.add("primitives of points are not shown; --point-radius METRES shows them as spheres");
        return {};
      case TINYGLTF_MODE_LINE:
      case TINYGLTF_MODE_LINE_LOOP:
      case TINYGLTF_MODE_LINE_STRIP:
        warnings_.add("primitives of lines are not shown; --point-radius METRES shows them as tubes");
        return {};
      default:
        document_.fail(place_ + ".mode", std::to_string(primitive_.mode) + " is not a mode of glTF");
    }
  }

  std::size_t corner_count(std::size_t vertex_count) const {
    return primitive_.indices >= 0 ? accessor_count(document_, primitive_.indices) : vertex_count;
  }

  std::vector<Triangle> assemble_thin(std::size_t& bytes_left) {
    const std::size_t count = corner_count(selection_.accessor_count);
    if (count >= invalid_id) document_.fail(place_, "has too many points or lines");
    charge(count * bytes_per_triangle, bytes_left);
    std::vector<std::uint32_t> corners;
    if (primitive_.indices >= 0) {
      corners = read_indices(document_, primitive_.indices, selection_.accessor_count, place_ + ".indices");
    } else {
      corners.resize(count);
      std::iota(corners.begin(), corners.end(), 0u);
    }
    return make_thin(*thin_mode_of(primitive_), corners);
  }

  std::vector<Triangle> assemble_triangles(TriangleMode mode, std::size_t& bytes_left) {
    if (const std::vector<Triangle>* decoded = document_.compressed_primitives().triangles(primitive_)) {
      charge(decoded->size() * bytes_per_triangle, bytes_left);
      return *decoded;  // whatever the mode
    }
    const bool is_indexed = primitive_.indices >= 0;
    const std::size_t corners = corner_count(selection_.accessor_count);
    const std::size_t triangles = triangle_count(mode, corners);
    if (triangles >= invalid_id) document_.fail(place_, "has too many triangles");
    charge(triangles * bytes_per_triangle, bytes_left);
    if (mode == TriangleMode::list && corners % 3 != 0) {
      warnings_.add(place_, "its number of corners is no multiple of 3, the last ones are ignored");
    }
    if (!is_indexed) return make_triangles(mode, corners);
    return make_triangles(mode,
                          read_indices(document_, primitive_.indices, selection_.accessor_count, place_ + ".indices"));
  }

  void check_positions(const Mesh& mesh) const {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      // Beyond 1e9 m, squared areas overflow single precision.
      const Vec3 p = glm::abs(mesh.positions[i]);
      if (p.x <= 1e9f && p.y <= 1e9f && p.z <= 1e9f) continue;
      document_.fail(attribute_place("POSITION"),
                     "accessor " + std::to_string(attribute("POSITION")) + " element " +
                         std::to_string(selection_.element(i)) +
                         (is_finite(p) ? " is farther than 1e9 m from the origin" : " is not finite"));
    }
  }

  void repair_uvs(Mesh& mesh) const {
    for (std::size_t set = 0; set < mesh.uvs.size(); ++set) {
      bool is_repaired = false;
      for (Vec2& uv : mesh.uvs[set]) {
        if (std::abs(uv.x) + std::abs(uv.y) < infinity) continue;
        uv = Vec2(0);
        is_repaired = true;
      }
      const std::string semantic = "TEXCOORD_" + std::to_string(set);
      if (is_repaired) warnings_.add(attribute_place(semantic), "has values that are not finite, 0 is used");
    }
  }

  void clamp_colors(Mesh& mesh) const {
    bool is_clamped = false;
    for (Vec4& color : mesh.colors) {
      for (int c = 0; c < 4; ++c) {
        if (color[c] >= 0 && color[c] <= 1) continue;
        color[c] = color[c] > 1 ? 1.0f : 0.0f;
        is_clamped = true;
      }
    }
    if (is_clamped) warnings_.add(attribute_place("COLOR_0"), "has values outside of [0, 1], they are clamped");
  }

  const GltfDocument& document_;
  const tinygltf::Primitive& primitive_;
  const std::string place_;
  Warnings& warnings_;
  VertexSelection selection_;
};

/// Warns where the material looks up uvs that the mesh does not have; they read as (0, 0).
void check_uv_sets(const Mesh& mesh, const Material& material, const std::string& place, Warnings& warnings) {
  for_each_texture_slot(material, [&](const TextureSlot& slot) {
    if (!slot.is_used() || !mesh.uvs[slot.uv_set].empty()) return;
    warnings.add(place, "has no TEXCOORD_" + std::to_string(slot.uv_set) + " for the textures of its material");
  });
}

/// The texture whose coordinates tangents follow where the file has none; nothing for a material that needs no
/// tangents, which would cost 16 bytes a vertex. One tangent space serves all textures: those of the extensions "should
/// use the same texture coordinates" as the normal texture.
const TextureSlot* slot_of_tangents(const Material& material) {
  if (material.normal_texture.is_used()) return &material.normal_texture;
  if (!material.extensions) return nullptr;
  const MaterialExtensions& more = *material.extensions;
  if (more.clearcoat_normal_texture.is_used()) return &more.clearcoat_normal_texture;
  return more.anisotropy > 0 ? &more.anisotropy_texture : nullptr;
}

bool has_same_coordinates(const TextureSlot& a, const TextureSlot& b) {
  return a.is_used() == b.is_used() && a.uv_set == b.uv_set && a.row_u == b.row_u && a.row_v == b.row_v;
}

}  // namespace

MeshReader::MeshReader(const GltfDocument& document, Scene& scene, MaterialTable& materials, Warnings& warnings,
                       float point_radius, GeometryCache* cache)
    : document_(document),
      scene_(scene),
      materials_(materials),
      warnings_(warnings),
      point_radius_(point_radius),
      cache_(cache) {
  constexpr std::size_t least = std::size_t{2} << 30, factor = 64;
  bytes_left_ = std::max(least, factor * document.total_bytes());
}

bool MeshReader::is_thick(std::size_t index) const {
  const std::vector<tinygltf::Primitive>& primitives = document_.model().meshes[index].primitives;
  return point_radius_ > 0 && std::any_of(primitives.begin(), primitives.end(), thin_mode_of);
}

Object MeshReader::read(std::size_t index, const Deformation& deformation, const Mat3& to_world) {
  const tinygltf::Mesh& source = document_.model().meshes[index];
  const std::string mesh_place = indexed("meshes", index);
  Object object{source.name.empty() ? mesh_place : kept_name(source.name),
                static_cast<std::uint32_t>(scene_.meshes.size()), 0};
  for (std::size_t p = 0; p < source.primitives.size(); ++p) {
    const tinygltf::Primitive& primitive = source.primitives[p];
    const std::string place = mesh_place + "." + indexed("primitives", p);
    PrimitiveReader reader(document_, primitive, place, warnings_);
    const ThinCounts thin = reader.thin_counts();
    thin_counts_.points += thin.points, thin_counts_.lines += thin.lines;
    const bool is_thick = point_radius_ > 0 && thin_mode_of(primitive);
    GeometryCache::Entry* const kept =
        cache_ == nullptr || is_thick ? nullptr : &cache_->primitives[{index, p, deformation.is_none()}];
    bool is_known = kept != nullptr && kept->is_read;
    std::optional<Mesh> mesh = is_known ? kept->mesh : reader.read(is_thick, bytes_left_);
    if (kept != nullptr) kept->is_read = true;
    if (!mesh) continue;
    const std::uint32_t material_id = materials_.material(primitive, place);
    const Material& material = scene_.materials[material_id];
    const TextureSlot* const slot = slot_of_tangents(material);
    const TextureSlot tangent_slot = slot == nullptr ? TextureSlot{} : *slot;
    // An animation can make a material one that needs tangents, or turn its textures.
    if (is_known && !has_same_coordinates(kept->tangent_slot, tangent_slot)) {
      mesh = reader.read(is_thick, bytes_left_);
      is_known = false;
    }
    mesh->name = object.name;
    mesh->material = material_id;
    check_uv_sets(*mesh, material, place, warnings_);
    if (is_known) {
      reader.reuse(*mesh, kept->selection, bytes_left_);
    } else if (slot != nullptr && !is_thick) {
      reader.read_tangents(*mesh);
    }
    // What does not move is kept ready for use, what does as it is in the file.
    if (kept != nullptr && !is_known && !deformation.is_none()) *kept = {true, tangent_slot, mesh, reader.selection()};
    if (!is_known || !deformation.is_none()) {
      reader.bend(deformation, *mesh, bytes_left_);
      reader.repair(*mesh);
      if (is_thick) reader.thicken(point_radius_, to_world, *mesh, bytes_left_);
      if (slot != nullptr && mesh->tangents.empty() && !mesh->uvs[slot->uv_set].empty()) {
        generate_tangents(*mesh, *slot);
      }
    }
    if (kept != nullptr && !is_known && deformation.is_none()) *kept = {true, tangent_slot, mesh, {}};
    scene_.meshes.push_back(std::move(*mesh));
    ++object.mesh_count;
  }
  return object;
}

}  // namespace candil

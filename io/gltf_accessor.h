/// Typed reads of accessors: every offset, stride, count and component type is checked before a byte is touched.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"
#include "io/gltf_document.h"

namespace candil {

/// The vertices of an accessor that a primitive uses. Primitives that each take a few vertices of one large accessor
/// are common; they must not cost the whole of it, neither in time nor in memory.
struct VertexSelection {
  std::size_t accessor_count = 0;  ///< Elements that each attribute must have.
  bool is_all = true;
  std::vector<std::uint32_t> vertices;  ///< Ascending; empty when all are used.

  std::size_t size() const { return is_all ? accessor_count : vertices.size(); }
  /// The element of the accessor that vertex `i` of the mesh comes from.
  std::size_t element(std::size_t i) const { return is_all ? i : vertices[i]; }
};

/// Number of elements of accessors[index].
std::size_t accessor_count(const GltfDocument& document, int index);

/// accessors[index] as floats: integers of 8 and 16 bits are converted, normalised to [0, 1] or [-1, 1] if the accessor
/// says so; sparse ones are substituted. Only the selected elements are read. `place` names the reference in messages.
/// Throws InputError for another shape or element count, for 32-bit integers, and for reads beyond the buffer view.
std::vector<Vec2> read_vec2(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place);
std::vector<Vec3> read_vec3(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place);
std::vector<Vec4> read_vec4(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place);
/// Three or four components; `alpha` stands for a missing fourth one.
std::vector<Vec4> read_color(const GltfDocument& document, int index, const VertexSelection& selection,
                             const std::string& place, float alpha = 1);

/// Unsigned scalars of 8, 16 or 32 bits, each below `vertex_count`. Throws InputError that names the element otherwise,
/// also for the largest value of the type, which stands for primitive restart (specification, section 3.7.2.1).
std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, std::size_t vertex_count,
                                        const std::string& place);

/// Elements [first, first + count) of accessors[index], of any type and one after the other, as floats: converted and
/// substituted as above. They must be there (accessor_count()). Throws InputError as above.
std::vector<float> read_floats(const GltfDocument& document, int index, std::size_t first, std::size_t count,
                               const std::string& place);

/// Type ("VEC3") and whether the components are floats, of accessors[index].
struct AccessorKind {
  std::string_view type;
  bool has_floats = false;
  std::size_t components = 0;
};
AccessorKind accessor_kind(const GltfDocument& document, int index);

/// Checks shape, component type and ranges of all accessors, used or not. Throws InputError.
void check_accessors(const GltfDocument& document);

}  // namespace candil

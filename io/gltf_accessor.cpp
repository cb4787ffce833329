#include "io/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "io/gltf_tinygltf.h"

namespace candil {

namespace {

/// Elements in memory, one every `stride` bytes.
struct StridedData {
  const std::byte* first = nullptr;  // null: all zeros
  std::size_t stride = 0, count = 0;
};

/// Calls `function` with a value of the C++ type of a component. Nothing else is a component type of
/// glTF 2.0, which check_gltf_schema() sees to.
template <class Function>
auto with_component_type(int type, Function&& function) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return function(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return function(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return function(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return function(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return function(std::uint32_t{});
    default:
      return function(float{});
  }
}

std::size_t component_bytes(int type) {
  return with_component_type(type, [](auto component) { return sizeof(component); });
}

/// Specification, section 3.6.2.4: columns of matrices start at multiples of four bytes.
std::size_t element_bytes(const tinygltf::Accessor& accessor) {
  const std::size_t component = component_bytes(accessor.componentType);
  const auto column = [&](std::size_t rows) { return (rows * component + 3) / 4 * 4; };
  switch (accessor.type) {
    case TINYGLTF_TYPE_MAT2:
      return 2 * column(2);
    case TINYGLTF_TYPE_MAT3:
      return 3 * column(3);
    case TINYGLTF_TYPE_MAT4:
      return 4 * column(4);
    default:
      return component * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(accessor.type));
  }
}

/// One accessor and everything known about it.
class AccessorReader {
 public:
  AccessorReader(const GltfDocument& document, int index, const std::string& place)
      : document_(document),
        index_(index),
        place_(place),
        accessor_(document.model().accessors[static_cast<std::size_t>(index)]) {}

  const tinygltf::Accessor& accessor() const { return accessor_; }

  [[noreturn]] void fail(const std::string& message) const {
    document_.fail(place_, "accessor " + std::to_string(index_) + " " + message);
  }

  StridedData base_data() const {
    const std::size_t size = element_bytes(accessor_);
    if (const Bytes* bytes = document_.compressed_primitives().accessor(index_)) {
      return {bytes->data(), size, accessor_.count};
    }
    if (accessor_.bufferView < 0) {
      // A few characters of text would otherwise fill the memory with zeros.
      constexpr std::size_t most_zeros = std::size_t{1} << 26;
      if (accessor_.count > most_zeros) fail("has no buffer view and too many elements");
      return {nullptr, size, accessor_.count};
    }
    const std::size_t stride = document_.model().bufferViews[std::size_t(accessor_.bufferView)].byteStride;
    if (stride != 0 && stride < size) {
      fail("has elements of " + std::to_string(size) + " bytes in a buffer view with a byteStride of " +
           std::to_string(stride));
    }
    return data_in_view(accessor_.bufferView, accessor_.byteOffset, stride == 0 ? size : stride, size, accessor_.count);
  }

  StridedData sparse_values() const {
    const std::size_t size = element_bytes(accessor_);
    return data_in_view(accessor_.sparse.values.bufferView, std::size_t(accessor_.sparse.values.byteOffset), size, size,
                        std::size_t(accessor_.sparse.count));
  }

  /// The elements that sparse_values() replaces, each within the accessor.
  std::vector<std::uint32_t> sparse_indices() const {
    const int type = accessor_.sparse.indices.componentType;
    const std::size_t size = component_bytes(type);
    const StridedData data =
        data_in_view(accessor_.sparse.indices.bufferView, std::size_t(accessor_.sparse.indices.byteOffset), size, size,
                     std::size_t(accessor_.sparse.count));
    std::vector<std::uint32_t> indices(data.count);
    for (std::size_t i = 0; i < data.count; ++i) {
      std::memcpy(&indices[i], data.first + i * size, size);  // glTF and x86-64 are both little-endian
      if (indices[i] >= accessor_.count) {
        fail("has the sparse index " + std::to_string(indices[i]) + " but only " + std::to_string(accessor_.count) +
             " elements");
      }
    }
    return indices;
  }

 private:
  StridedData data_in_view(int view, std::size_t offset, std::size_t stride, std::size_t size,
                           std::size_t count) const {
    const std::span<const std::byte> bytes = document_.buffer_view(std::size_t(view));
    if (count == 0) return {};
    // All but the size of the last element is padded to the stride; offset and count are below 2^49, the stride below
    // 256.
    const std::size_t end = offset + (count - 1) * stride + size;
    if (end > bytes.size()) {
      fail("reads " + std::to_string(end - bytes.size()) + " bytes beyond buffer view " + std::to_string(view));
    }
    return {bytes.data() + offset, stride, count};
  }

  const GltfDocument& document_;
  int index_;
  const std::string& place_;
  const tinygltf::Accessor& accessor_;
};

template <class Component>
float to_float(Component value, bool is_normalized) {
  if constexpr (std::is_floating_point_v<Component>) {
    return value;
  } else {
    if (!is_normalized) return static_cast<float>(value);
    // Section 3.11 of the specification: f = max(c / 127, -1) and so on.
    return glm::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<Component>::max()), -1.0f);
  }
}

/// Calls visit(i, convert) for i in [0, count), where convert(bytes, vector) converts one element of the accessor and
/// leaves alone the components that the file does not have. The component type is looked at once.
template <class Visit>
void for_each_element(const AccessorReader& reader, std::size_t count, Visit visit) {
  const int components = tinygltf::GetNumComponentsInType(reader.accessor().type);
  const bool is_normalized = reader.accessor().normalized;
  with_component_type(reader.accessor().componentType, [&](auto zero) {
    using Component = decltype(zero);
    const auto convert = [=](const std::byte* bytes, auto& vector) {
      Component source[4];
      std::memcpy(source, bytes, sizeof(Component) * static_cast<std::size_t>(components));
      for (int c = 0; c < components; ++c) vector[c] = to_float(source[c], is_normalized);
    };
    for (std::size_t i = 0; i < count; ++i) visit(i, convert);
  });
}

template <class Vector>
void substitute_sparse(const AccessorReader& reader, const VertexSelection& selection, std::vector<Vector>& elements) {
  const std::vector<std::uint32_t> targets = reader.sparse_indices();
  const StridedData values = reader.sparse_values();
  for_each_element(reader, values.count, [&](std::size_t i, auto convert) {
    std::size_t target = targets[i];
    if (!selection.is_all) {
      const auto found = std::lower_bound(selection.vertices.begin(), selection.vertices.end(), targets[i]);
      if (found == selection.vertices.end() || *found != targets[i]) return;
      target = static_cast<std::size_t>(found - selection.vertices.begin());
    }
    convert(values.first + i * values.stride, elements[target]);
  });
}

/// `least_components` to Vector::length() components; missing ones are those of `fill`.
template <class Vector>
std::vector<Vector> read_vectors(const GltfDocument& document, int index, const VertexSelection& selection,
                                 const std::string& place, int least_components, Vector fill) {
  const AccessorReader reader(document, index, place);
  const tinygltf::Accessor& accessor = reader.accessor();
  if (accessor.count != selection.accessor_count) {
    reader.fail("has " + std::to_string(accessor.count) + " elements, POSITION has " +
                std::to_string(selection.accessor_count));
  }
  const bool is_vector =
      accessor.type == TINYGLTF_TYPE_VEC2 || accessor.type == TINYGLTF_TYPE_VEC3 || accessor.type == TINYGLTF_TYPE_VEC4;
  const int components = is_vector ? tinygltf::GetNumComponentsInType(accessor.type) : 0;
  if (components < least_components || components > Vector::length()) {
    const std::string wanted = "VEC" + std::to_string(least_components);
    reader.fail("must be of type " + wanted + (least_components < Vector::length() ? " or VEC4" : ""));
  }
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    reader.fail("must not have the componentType UNSIGNED_INT here");
  }
  const StridedData data = reader.base_data();
  if (accessor.bufferView < 0) {
    for (int c = 0; c < components; ++c) fill[c] = 0;
  }
  std::vector<Vector> elements(selection.size(), fill);
  const bool is_copy = selection.is_all && accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT &&
                       components == Vector::length() && data.stride == sizeof(Vector);
  if (data.first != nullptr && is_copy) {
    std::memcpy(static_cast<void*>(elements.data()), data.first, data.count * sizeof(Vector));
  } else if (data.first != nullptr) {
    for_each_element(reader, elements.size(), [&](std::size_t i, auto convert) {
      convert(data.first + selection.element(i) * data.stride, elements[i]);
    });
  }
  if (accessor.sparse.isSparse) substitute_sparse(reader, selection, elements);
  return elements;
}

template <class Component>
void check_index_range(const AccessorReader& reader, const std::vector<std::uint32_t>& indices,
                       std::size_t vertex_count) {
  const auto highest = std::max_element(indices.begin(), indices.end());
  const bool is_restart = highest != indices.end() && *highest == std::numeric_limits<Component>::max();
  if (highest == indices.end() || (*highest < vertex_count && !is_restart)) return;
  reader.fail(
      "element " + std::to_string(highest - indices.begin()) + " is " + std::to_string(*highest) +
      (is_restart ? ", the primitive restart value; the mesh has " : ", beyond the last vertex; the mesh has ") +
      std::to_string(vertex_count) + " vertices");
}

}  // namespace

std::size_t accessor_count(const GltfDocument& document, int index) {
  return document.model().accessors[static_cast<std::size_t>(index)].count;
}

std::vector<Vec2> read_vec2(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place) {
  return read_vectors(document, index, selection, place, 2, Vec2(0));
}

std::vector<Vec3> read_vec3(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place) {
  return read_vectors(document, index, selection, place, 3, Vec3(0));
}

std::vector<Vec4> read_vec4(const GltfDocument& document, int index, const VertexSelection& selection,
                            const std::string& place) {
  return read_vectors(document, index, selection, place, 4, Vec4(0));
}

std::vector<Vec4> read_color(const GltfDocument& document, int index, const VertexSelection& selection,
                             const std::string& place, float alpha) {
  return read_vectors(document, index, selection, place, 3, Vec4(0, 0, 0, alpha));
}

std::vector<std::uint32_t> read_indices(const GltfDocument& document, int index, std::size_t vertex_count,
                                        const std::string& place) {
  const AccessorReader reader(document, index, place);
  const tinygltf::Accessor& accessor = reader.accessor();
  if (accessor.type != TINYGLTF_TYPE_SCALAR) reader.fail("must be of type SCALAR");
  const StridedData data = reader.base_data();
  return with_component_type(accessor.componentType, [&](auto zero) {
    using Component = decltype(zero);
    std::vector<std::uint32_t> indices(accessor.count);
    if constexpr (std::is_floating_point_v<Component> || std::is_signed_v<Component>) {
      reader.fail("must have unsigned integers for indices");
    } else {
      for (std::size_t i = 0; i < data.count && data.first != nullptr; ++i) {
        Component source;
        std::memcpy(&source, data.first + i * data.stride, sizeof source);
        indices[i] = source;
      }
      if (accessor.sparse.isSparse) {
        const std::vector<std::uint32_t> targets = reader.sparse_indices();
        const StridedData values = reader.sparse_values();
        for (std::size_t i = 0; i < targets.size(); ++i) {
          Component source;
          std::memcpy(&source, values.first + i * values.stride, sizeof source);
          indices[targets[i]] = source;
        }
      }
      check_index_range<Component>(reader, indices, vertex_count);
    }
    return indices;
  });
}

std::vector<float> read_floats(const GltfDocument& document, int index, std::size_t first, std::size_t count,
                               const std::string& place) {
  const AccessorReader reader(document, index, place);
  const tinygltf::Accessor& accessor = reader.accessor();
  const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(accessor.type));
  if (element_bytes(accessor) != components * component_bytes(accessor.componentType)) {
    reader.fail("must not have padded columns here");
  }
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    reader.fail("must not have the componentType UNSIGNED_INT here");
  }
  std::vector<float> values(count * components);
  const StridedData data = reader.base_data();
  with_component_type(accessor.componentType, [&](auto zero) {
    using Component = decltype(zero);
    const auto convert = [&](const std::byte* bytes, float* element) {
      for (std::size_t c = 0; c < components; ++c) {
        Component source;
        std::memcpy(&source, bytes + c * sizeof source, sizeof source);
        element[c] = to_float(source, accessor.normalized);
      }
    };
    for (std::size_t i = 0; i < count && data.first != nullptr; ++i) {
      convert(data.first + (first + i) * data.stride, &values[i * components]);
    }
    if (!accessor.sparse.isSparse) return;
    const std::vector<std::uint32_t> targets = reader.sparse_indices();
    const StridedData substitutes = reader.sparse_values();
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (targets[i] < first || targets[i] - first >= count) continue;
      convert(substitutes.first + i * substitutes.stride, &values[(targets[i] - first) * components]);
    }
  });
  return values;
}

AccessorKind accessor_kind(const GltfDocument& document, int index) {
  const tinygltf::Accessor& accessor = document.model().accessors[static_cast<std::size_t>(index)];
  const std::string_view type = [&] {
    switch (accessor.type) {
      case TINYGLTF_TYPE_SCALAR:
        return "SCALAR";
      case TINYGLTF_TYPE_VEC2:
        return "VEC2";
      case TINYGLTF_TYPE_VEC3:
        return "VEC3";
      case TINYGLTF_TYPE_VEC4:
        return "VEC4";
      case TINYGLTF_TYPE_MAT2:
        return "MAT2";
      case TINYGLTF_TYPE_MAT3:
        return "MAT3";
      default:
        return "MAT4";
    }
  }();
  return {type, accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT,
          static_cast<std::size_t>(tinygltf::GetNumComponentsInType(accessor.type))};
}

void check_accessors(const GltfDocument& document) {
  for (std::size_t i = 0; i < document.model().accessors.size(); ++i) {
    const std::string place = "accessors[" + std::to_string(i) + "]";
    const AccessorReader reader(document, static_cast<int>(i), place);
    reader.base_data();
    if (reader.accessor().sparse.isSparse) {
      reader.sparse_indices();
      reader.sparse_values();
    }
  }
}

}  // namespace candil

// KHR_materials_variants.
#include <algorithm>

#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"

namespace candil {

std::optional<std::size_t> choose_variant(const GltfDocument& document, const std::string& chosen) {
  if (chosen.empty()) return {};
  return find_choice(document, "variant", document.contents().variants, chosen);
}

int material_of_variant(const tinygltf::Primitive& primitive, std::optional<std::size_t> variant,
                        const std::string& place, Warnings& warnings) {
  const auto extension = primitive.extensions.find("KHR_materials_variants");
  if (!variant || extension == primitive.extensions.end()) return primitive.material;
  const tinygltf::Value& mappings = extension->second.Get("mappings");
  std::optional<int> material;
  for (std::size_t m = 0; m < mappings.ArrayLen(); ++m) {
    const tinygltf::Value& mapping = mappings.Get(m);
    const tinygltf::Value& variants = mapping.Get("variants");
    for (std::size_t v = 0; v < variants.ArrayLen(); ++v) {
      if (static_cast<std::size_t>(variants.Get(v).GetNumberAsInt()) != *variant) continue;
      if (material) {
        warnings.add(place + ".extensions.KHR_materials_variants.mappings",
                     "map variant " + std::to_string(*variant) + " more than once, the first mapping is used");
        return *material;
      }
      material = mapping.Get("material").GetNumberAsInt();
    }
  }
  return material.value_or(primitive.material);
}

}  // namespace candil

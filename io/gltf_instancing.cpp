#include <glm/gtc/quaternion.hpp>

#include "io/gltf_accessor.h"
#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/placement.h"

namespace candil {

namespace {

/// The accessors of the extension by their semantics, also those of the application ("_ID"), which must agree in their
/// number of elements.
class InstanceAttributes {
 public:
  InstanceAttributes(const GltfDocument& document, const tinygltf::Value& extension, const std::string& place)
      : document_(document), place_(place + ".attributes") {
    if (!extension.Has("attributes")) return;
    const tinygltf::Value& attributes = extension.Get("attributes");
    for (const std::string& semantic : attributes.Keys()) {
      const int accessor = attributes.Get(semantic).GetNumberAsInt();
      const std::size_t count = accessor_count(document, accessor);
      if (accessors_.empty()) selection_.accessor_count = count;
      if (count != selection_.accessor_count) {
        document.fail(place_ + "." + printable(semantic), "has " + std::to_string(count) + " elements, " +
                                                              printable(accessors_.begin()->first) + " has " +
                                                              std::to_string(selection_.accessor_count));
      }
      accessors_[semantic] = accessor;
    }
  }

  bool is_empty() const { return accessors_.empty(); }
  std::size_t count() const { return selection_.accessor_count; }

  std::vector<Vec3> vectors(const char* semantic, Vec3 otherwise) const {
    const auto found = accessors_.find(semantic);
    if (found == accessors_.end()) return std::vector<Vec3>(count(), otherwise);
    return read_vec3(document_, found->second, selection_, place_ + "." + semantic);
  }

  std::vector<Vec4> rotations() const {
    const auto found = accessors_.find("ROTATION");
    if (found == accessors_.end()) return std::vector<Vec4>(count(), Vec4(0, 0, 0, 1));
    return read_vec4(document_, found->second, selection_, place_ + ".ROTATION");
  }

 private:
  const GltfDocument& document_;
  const std::string place_;
  std::map<std::string, int> accessors_;
  VertexSelection selection_;
};

Affine compose(Vec3 translation, Vec4 rotation, Vec3 scale) {
  const glm::dquat turn(rotation.w, rotation.x, rotation.y, rotation.z);
  const double length = glm::length(turn);
  Affine transform{length == 0 ? Mat3(1.0f) : Mat3(glm::mat3_cast(turn / length)), translation};
  for (int axis = 0; axis < 3; ++axis) transform.linear[axis] *= scale[axis];
  return transform;
}

}  // namespace

std::vector<Affine> instance_transforms(const GltfDocument& document, std::size_t node, std::size_t& instances_left) {
  const auto& extensions = document.model().nodes[node].extensions;
  const auto extension = extensions.find("EXT_mesh_gpu_instancing");
  if (extension == extensions.end()) return {Affine{}};
  const std::string place = indexed("nodes", node) + ".extensions.EXT_mesh_gpu_instancing";
  const InstanceAttributes attributes(document, extension->second, place);
  if (attributes.is_empty()) return {Affine{}};
  if (attributes.count() > instances_left) {
    document.fail(place, "makes more than " + std::to_string(most_gpu_instances) + " instances in the scene");
  }
  instances_left -= attributes.count();

  const std::vector<Vec3> translations = attributes.vectors("TRANSLATION", Vec3(0));
  const std::vector<Vec4> rotations = attributes.rotations();
  const std::vector<Vec3> scales = attributes.vectors("SCALE", Vec3(1));
  std::vector<Affine> transforms(attributes.count());
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    transforms[i] = compose(translations[i], rotations[i], scales[i]);
    if (!is_finite(transforms[i])) document.fail(place, "instance " + std::to_string(i) + " is not finite");
  }
  return transforms;
}

}  // namespace candil

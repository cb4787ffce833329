#include <cmath>

#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/placement.h"

namespace candil {

namespace {

/// Nothing (and a warning) for a camera that can show no image. Clipping planes have no meaning for rays.
std::optional<Camera> make_camera(const tinygltf::Camera& source, const std::string& place, Warnings& warnings) {
  Camera camera;
  if (source.type == "perspective") {
    const tinygltf::PerspectiveCamera& lens = source.perspective;
    if (!(lens.yfov > 0 && lens.yfov < std::numbers::pi)) {
      warnings.add(place + ".perspective.yfov", "must be between 0 and pi, the camera is ignored");
      return {};
    }
    camera.yfov = static_cast<float>(lens.yfov);
    if (lens.aspectRatio > 0) camera.aspect = static_cast<float>(lens.aspectRatio);
    if (lens.aspectRatio < 0) warnings.add(place + ".perspective.aspectRatio", "must be above 0, it is ignored");
    return camera;
  }
  camera.kind = CameraKind::orthographic;
  camera.xmag = static_cast<float>(std::abs(source.orthographic.xmag));
  camera.ymag = static_cast<float>(std::abs(source.orthographic.ymag));
  if (camera.xmag == 0 || camera.ymag == 0) {
    warnings.add(place + ".orthographic", "xmag and ymag must not be 0, the camera is ignored");
    return {};
  }
  camera.aspect = camera.xmag / camera.ymag;
  return camera;
}

}  // namespace

void add_cameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene, Warnings& warnings) {
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model().nodes[placed.node];
    if (node.camera < 0) continue;
    const auto index = static_cast<std::size_t>(node.camera);
    const tinygltf::Camera& source = document.model().cameras[index];
    std::optional<Camera> camera = make_camera(source, indexed("cameras", index), warnings);
    if (!camera) continue;
    camera->name = kept_name(source.name.empty() ? node.name : source.name);
    camera->to_world = placed.to_world;
    camera->focus_distance = 0;  // glTF has no lenses
    if (!is_usable(*camera)) {
      warnings.add(indexed("nodes", placed.node) + ".camera",
                   "is too far away, scaled to nothing or frames too much; it is ignored");
      continue;
    }
    scene.cameras.push_back(std::move(*camera));
  }
}

}  // namespace candil

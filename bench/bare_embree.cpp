#include "bench/bare_embree.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#if CANDIL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace candil {

struct BareEmbree::Handles {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene top = new_scene();
  std::vector<RTCScene> objects;  // released with the top-level scene, which holds on to those that it uses

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  RTCScene new_scene() const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
  }
  ~Handles() {
    for (RTCScene scene : objects)
      if (scene) rtcReleaseScene(scene);
    rtcReleaseScene(top);
    rtcReleaseDevice(device);
  }
};

namespace {

bool is_plain(const Scene& scene) {
  return scene.shapes.empty() && std::ranges::all_of(scene.materials, [](const Material& material) {
           return material.alpha_mode == AlphaMode::opaque;
         });
}

void attach(RTCGeometry geometry, RTCScene scene) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

void add_mesh(const Mesh& mesh, RTCDevice device, RTCScene scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), mesh.positions.size()));
  std::ranges::copy(mesh.positions, vertices);
  auto* const triangles = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
  std::ranges::copy(mesh.triangles, triangles);
  attach(geometry, scene);
}

void add_object(const Scene& scene, const Object& object, RTCDevice device, RTCScene target) {
  for (std::uint32_t m = 0; m < object.mesh_count; ++m) add_mesh(scene.meshes[object.first_mesh + m], device, target);
}

void add_instance(const Affine& to_world, RTCScene object, RTCDevice device, RTCScene target) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, object);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &to_world);
  attach(geometry, target);
}

RTCRay make_query(const Ray& ray) {
  RTCRay query;
  query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
  query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
  query.tnear = 0, query.tfar = ray.t_max;
  query.time = 0, query.mask = ~0U, query.id = 0, query.flags = 0;
  return query;
}

}  // namespace

std::optional<BareEmbree> BareEmbree::make(const Scene& scene) {
  if (!is_plain(scene)) return std::nullopt;
  const auto handles = std::make_shared<Handles>();
  handles->objects.resize(scene.objects.size());
  for (const Instance& instance : scene.instances) {
    const Object& object = scene.objects[instance.object];
    if (instance.is_world_space) {
      add_object(scene, object, handles->device, handles->top);
      continue;
    }
    RTCScene& shared = handles->objects[instance.object];
    if (!shared) {
      shared = handles->new_scene();
      add_object(scene, object, handles->device, shared);
      rtcCommitScene(shared);
    }
    add_instance(instance.to_world, shared, handles->device, handles->top);
  }
  rtcCommitScene(handles->top);
  if (rtcGetDeviceError(handles->device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
  BareEmbree bare;
  bare.handles_ = handles;
  return bare;
}

std::uint64_t BareEmbree::shoot(std::span<const Ray> rays, RayKind kind) const {
#if CANDIL_EMBREE_MAJOR < 4
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
#endif
  std::uint64_t found = 0;
  if (kind == RayKind::shadow) {
    for (const Ray& ray : rays) {
      RTCRay query = make_query(ray);
#if CANDIL_EMBREE_MAJOR >= 4
      rtcOccluded1(handles_->top, &query);
#else
      rtcOccluded1(handles_->top, &context, &query);
#endif
      found += query.tfar < 0;
    }
    return found;
  }
  for (const Ray& ray : rays) {
    RTCRayHit query;
    query.ray = make_query(ray);
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if CANDIL_EMBREE_MAJOR >= 4
    rtcIntersect1(handles_->top, &query);
#else
    rtcIntersect1(handles_->top, &context, &query);
#endif
    found += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  return found;
}

}  // namespace candil

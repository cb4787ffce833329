#include "core/embree_accelerator.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "core/embree_api.h"
#include "core/embree_callbacks.h"
#include "core/shape_target.h"

namespace candil {
namespace {

using namespace embree;

/// The configuration of a device, in the words of Embree's manual.
std::string device_configuration(const AcceleratorOptions& options) {
  std::string text;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) text += (text.empty() ? "" : ",") + std::string(key) + "=" + value;
  };
  add("isa", options.isa);
  add("frequency_level", options.frequency_level);
  return text;
}

RTCBuildQuality build_quality(BuildQuality quality) {
  switch (quality) {
    case BuildQuality::low:
      return RTC_BUILD_QUALITY_LOW;
    case BuildQuality::medium:
      return RTC_BUILD_QUALITY_MEDIUM;
    case BuildQuality::high:
      break;
  }
  return RTC_BUILD_QUALITY_HIGH;
}

class EmbreeAccelerator final : public Accelerator {
 public:
  EmbreeAccelerator(const Scene& scene, HitFilter filter, const AcceleratorOptions& options);

  std::optional<Hit> intersect(const Ray& ray) const override {
    Hit hit;
    intersect_each({&ray, 1}, {&hit, 1});
    if (hit.is_miss()) return std::nullopt;
    return hit;
  }

  void intersect_each(std::span<const Ray> rays, std::span<Hit> hits) const override {
    if (planes_.is_empty()) {
      find_each<false>(rays, hits);
    } else {
      find_each<true>(rays, hits);
    }
  }

  bool occluded(const Ray& ray) const override {
    if (!planes_.is_empty() && planes_.occluded(ray)) return true;
    FilterContext context;
    init_context(context.embree);
    context.ray = &ray;
    RTCRay query;
    fill(query, ray, ray.t_max);
    query_occluded(top_.get(), context.embree, query);
    return query.tfar < 0;
  }

  std::size_t memory_bytes() const override { return static_cast<std::size_t>(memory_.load()); }

 private:
  template <bool has_planes>
  void find_each(std::span<const Ray> rays, std::span<Hit> hits) const {
    FilterContext context;
    init_context(context.embree);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i];
      Hit& hit = hits[i];  // field by field: a copy would wait for the stores
      float t_max = ray.t_max;
      if constexpr (has_planes) {
        hit = planes_.intersect(ray);
        t_max = glm::min(t_max, hit.t);
      }
      context.ray = &ray;
      RTCRayHit query;
      fill(query.ray, ray, t_max);
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      query_intersect(top_.get(), context.embree, query);
      if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        if constexpr (!has_planes) hit.t = infinity;
        continue;
      }
      hit.t = query.ray.tfar;
      hit.barycentric = {query.hit.u, query.hit.v};
      hit.triangle = query.hit.primID;
      if (query.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) {
        hit.instance = records_[query.hit.geomID].instance;
        hit.mesh = records_[query.hit.geomID].mesh;
      } else {
        hit.instance = instance_of_top_id_[query.hit.instID[0]];
        hit.mesh = scene_.objects[scene_.instances[hit.instance].object].first_mesh + query.hit.geomID;
      }
    }
  }
  static void fill(RTCRay& query, const Ray& ray, float t_max) {
    query.org_x = ray.origin.x, query.org_y = ray.origin.y, query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x, query.dir_y = ray.direction.y, query.dir_z = ray.direction.z;
    query.tnear = 0, query.tfar = t_max;
    query.time = 0, query.mask = ~0U, query.id = 0, query.flags = 0;
  }
  static bool count_memory(void* user, ssize_t bytes, bool /*post*/) {
    static_cast<EmbreeAccelerator*>(user)->memory_ += bytes;
    return true;
  }
  void check(const char* doing) const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::runtime_error("Embree ran out of memory");
    if (error != RTC_ERROR_NONE) {
      throw std::runtime_error(std::string("Embree failed while ") + doing + " (error " + std::to_string(error) + ")");
    }
  }
  SceneHandle new_scene() const;
  Geometry triangle_geometry(std::uint32_t mesh, GeometryRecord& record) const;
  void add_shapes();

  const Scene& scene_;
  HitFilter filter_;
  AcceleratorOptions options_;
  std::atomic<std::ptrdiff_t> memory_{0};  // before the device, which reports to it until its end
  Device device_;
  Shapes shapes_;  // before the scene that points to it
  PlaneSet planes_;
  std::vector<SceneHandle> object_scenes_;  // per object; empty where it stands in the top-level scene
  SceneHandle top_;
  std::vector<std::uint32_t> instance_of_top_id_;  // per geometry id of the top-level scene
  std::vector<GeometryRecord> records_;            // per geometry id of the top-level scene
  std::vector<GeometryRecord> mesh_records_;       // per mesh, for the meshes of instanced objects
};

SceneHandle EmbreeAccelerator::new_scene() const {
  SceneHandle scene(rtcNewScene(device_.get()));
  int flags = RTC_SCENE_FLAG_NONE;
  if (options_.is_robust) flags |= RTC_SCENE_FLAG_ROBUST;  // watertight at shared edges
  if (options_.is_compact) flags |= RTC_SCENE_FLAG_COMPACT;
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(scene.get(), build_quality(options_.quality));
  return scene;
}

Geometry EmbreeAccelerator::triangle_geometry(std::uint32_t mesh_id, GeometryRecord& record) const {
  const Mesh& mesh = scene_.meshes[mesh_id];
  Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  // Vertices are copied: Embree reads four bytes past the last one, and owns buffers that are padded for that.
  void* vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                           mesh.positions.size());
  check("allocating vertices");
  std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<Vec3*>(vertices));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(Triangle), mesh.triangles.size());
  record.scene = &scene_;
  record.filter = filter_;
  record.instance_of_top_id = &instance_of_top_id_;
  record.mesh = mesh_id;
  if (filter_.needs_filter && filter_.needs_filter(scene_, scene_.materials[mesh.material])) {
    rtcSetGeometryUserData(geometry.get(), &record);
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filter_hit);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter_hit);
  }
  rtcCommitGeometry(geometry.get());
  return geometry;
}

void EmbreeAccelerator::add_shapes() {
  if (shapes_.empty()) return;
  records_.emplace_back();
  instance_of_top_id_.resize(records_.size(), invalid_id);
  const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(shapes_.size()));
  rtcSetGeometryUserData(geometry.get(), &shapes_);
  rtcSetGeometryBoundsFunction(geometry.get(), bound_shape, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), intersect_shape);
  rtcSetGeometryOccludedFunction(geometry.get(), occlude_by_shape);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(top_.get(), geometry.get(), static_cast<unsigned>(records_.size() - 1));
}

EmbreeAccelerator::EmbreeAccelerator(const Scene& scene, HitFilter filter, const AcceleratorOptions& options)
    : scene_(scene),
      filter_(filter),
      options_(options),
      device_(rtcNewDevice(device_configuration(options).c_str())),
      shapes_(bounded_shapes(scene, filter)),
      planes_(scene, filter) {
  if (!device_.get()) throw std::runtime_error("Embree cannot be started");
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_memory, this);

  // One object, one bottom-level scene, unless its vertices are in world space already.
  object_scenes_.resize(scene.objects.size());
  mesh_records_.resize(scene.meshes.size());
  for (const Instance& instance : scene.instances) {
    if (instance.is_world_space || object_scenes_[instance.object].get()) continue;
    const Object& object = scene.objects[instance.object];
    SceneHandle& bottom = object_scenes_[instance.object] = new_scene();
    for (std::uint32_t i = 0; i < object.mesh_count; ++i) {
      const std::uint32_t mesh = object.first_mesh + i;
      rtcAttachGeometryByID(bottom.get(), triangle_geometry(mesh, mesh_records_[mesh]).get(), i);
    }
    rtcCommitScene(bottom.get());
    check("building an object");
  }

  std::size_t top_count = shapes_.empty() ? 0 : 1;
  for (const Instance& instance : scene.instances) {
    top_count += instance.is_world_space ? scene.objects[instance.object].mesh_count : 1;
  }
  records_.reserve(top_count);  // Embree keeps pointers to them
  top_ = new_scene();
  for (std::uint32_t id = 0; id < scene.instances.size(); ++id) {
    const Instance& instance = scene.instances[id];
    const Object& object = scene.objects[instance.object];
    if (instance.is_world_space) {
      for (std::uint32_t i = 0; i < object.mesh_count; ++i) {
        GeometryRecord& record = records_.emplace_back();
        const Geometry geometry = triangle_geometry(object.first_mesh + i, record);
        record.instance = id;
        rtcAttachGeometryByID(top_.get(), geometry.get(), static_cast<unsigned>(records_.size() - 1));
      }
      instance_of_top_id_.resize(records_.size(), id);
      continue;
    }
    const Mat3& m = instance.to_world.linear;
    const float determinant = glm::determinant(m);
    if (determinant == 0 || !(std::abs(determinant) < infinity)) continue;  // flat: no ray can hit it
    records_.emplace_back().instance = id;
    instance_of_top_id_.resize(records_.size(), id);
    const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), object_scenes_[instance.object].get());
    const Vec3 t = instance.to_world.translation;
    const float columns[12] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(top_.get(), geometry.get(), static_cast<unsigned>(records_.size() - 1));
  }
  add_shapes();
  rtcCommitScene(top_.get());
  check("building the scene");
}

}  // namespace

std::unique_ptr<Accelerator> make_embree_accelerator(const Scene& scene, HitFilter filter,
                                                     const AcceleratorOptions& options) {
  return std::make_unique<EmbreeAccelerator>(scene, filter, options);
}

std::string embree_version() {
  const Device device(rtcNewDevice("threads=1"));
  if (!device.get()) return "unknown";
  const auto part = [&](RTCDeviceProperty property) {
    return std::to_string(rtcGetDeviceProperty(device.get(), property));
  };
  return part(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + part(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
         part(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace candil

// The only file that sees Embree, 3.13 or 4.x; what differs between them is in the first part.
#include <atomic>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/accelerator.h"
#include "core/shape_target.h"

#if CANDIL_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace candil {
namespace {

#if CANDIL_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
void init_context(QueryContext& context) { rtcInitRayQueryContext(&context); }
void query_intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &ray, &arguments);
}
void query_occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using QueryContext = RTCIntersectContext;
void init_context(QueryContext& context) { rtcInitIntersectContext(&context); }
void query_intersect(RTCScene scene, QueryContext& context, RTCRayHit& ray) { rtcIntersect1(scene, &context, &ray); }
void query_occluded(RTCScene scene, QueryContext& context, RTCRay& ray) { rtcOccluded1(scene, &context, &ray); }
#endif

/// Owns one reference to an Embree object.
template <typename Handle, void (*release)(Handle)>
class Owner {
 public:
  explicit Owner(Handle handle = nullptr) : handle_(handle) {}
  Owner(Owner&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owner& operator=(Owner&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owner() {
    if (handle_) release(handle_);
  }
  Handle get() const { return handle_; }

 private:
  Handle handle_;
};
using Device = Owner<RTCDevice, rtcReleaseDevice>;
using EmbreeScene = Owner<RTCScene, rtcReleaseScene>;
using Geometry = Owner<RTCGeometry, rtcReleaseGeometry>;

/// What a geometry id stands for. In the top-level scene the instance is known; in an object's scene the hit tells it.
struct GeometryRecord {
  const Scene* scene = nullptr;
  HitFilter filter;
  const std::vector<std::uint32_t>* instance_of_top_id = nullptr;
  std::uint32_t instance = invalid_id;  // invalid_id: shared by several
  std::uint32_t mesh = invalid_id;      // invalid_id: an Embree instance, or (without an instance either) the shapes
};

/// Handed through Embree to the filter function.
struct FilterContext {
  QueryContext embree;
  const Ray* ray;
};

void filter_hit(const RTCFilterFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& record = *static_cast<const GeometryRecord*>(arguments->geometryUserPtr);
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  RTCHitN* hit = arguments->hit;
  const unsigned n = arguments->N;
  const Vec3 normal(RTCHitN_Ng_x(hit, n, 0), RTCHitN_Ng_y(hit, n, 0), RTCHitN_Ng_z(hit, n, 0));
  RTCRayN* ray = arguments->ray;
  const Vec3 direction(RTCRayN_dir_x(ray, n, 0), RTCRayN_dir_y(ray, n, 0), RTCRayN_dir_z(ray, n, 0));
  const std::uint32_t instance =
      record.instance != invalid_id ? record.instance : (*record.instance_of_top_id)[RTCHitN_instID(hit, n, 0, 0)];
  const Hit candidate{RTCRayN_tfar(ray, n, 0),
                      {RTCHitN_u(hit, n, 0), RTCHitN_v(hit, n, 0)},
                      instance,
                      record.mesh,
                      RTCHitN_primID(hit, n, 0)};
  const bool is_front_face = glm::dot(direction, normal) < 0;  // both in the object's space
  if (!record.filter.accept(*record.scene, *context.ray, candidate, is_front_face)) arguments->valid[0] = 0;
}

// Spheres and discs are one user geometry: its user data is the vector of them. Queries are of single rays, so N is 1.
using Shapes = std::vector<ShapeTarget>;

void bound_shape(const RTCBoundsFunctionArguments* arguments) {
  const Bounds bounds = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID].bounds();
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = bounds.low.x, box.lower_y = bounds.low.y, box.lower_z = bounds.low.z;
  box.upper_x = bounds.high.x, box.upper_y = bounds.high.y, box.upper_z = bounds.high.z;
}

void intersect_shape(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  RTCRayN* ray = RTCRayHitN_RayN(arguments->rayhit, 1);
  const ShapeTarget& shape = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID];
  const Hit found = shape.intersect(*context.ray, RTCRayN_tfar(ray, 1, 0));
  if (found.is_miss()) return;
  RTCRayN_tfar(ray, 1, 0) = found.t;
  RTCHitN* hit = RTCRayHitN_HitN(arguments->rayhit, 1);
  RTCHitN_u(hit, 1, 0) = found.barycentric.x;
  RTCHitN_v(hit, 1, 0) = found.barycentric.y;
  RTCHitN_primID(hit, 1, 0) = found.triangle;  // into Scene::shapes
  RTCHitN_geomID(hit, 1, 0) = arguments->geomID;
  RTCHitN_instID(hit, 1, 0, 0) = RTC_INVALID_GEOMETRY_ID;
}

void occlude_by_shape(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  const ShapeTarget& shape = (*static_cast<const Shapes*>(arguments->geometryUserPtr))[arguments->primID];
  float& t_far = RTCRayN_tfar(arguments->ray, 1, 0);
  if (!shape.intersect(*context.ray, t_far).is_miss()) t_far = -infinity;
}

class EmbreeAccelerator final : public Accelerator {
 public:
  EmbreeAccelerator(const Scene& scene, HitFilter filter);

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
  EmbreeScene new_scene() const;
  Geometry triangle_geometry(std::uint32_t mesh, GeometryRecord& record) const;
  void add_shapes();

  const Scene& scene_;
  HitFilter filter_;
  std::atomic<std::ptrdiff_t> memory_{0};  // before the device, which reports to it until its end
  Device device_;
  Shapes shapes_;  // before the scene that points to it
  PlaneSet planes_;
  std::vector<EmbreeScene> object_scenes_;  // per object; empty where it stands in the top-level scene
  EmbreeScene top_;
  std::vector<std::uint32_t> instance_of_top_id_;  // per geometry id of the top-level scene
  std::vector<GeometryRecord> records_;            // per geometry id of the top-level scene
  std::vector<GeometryRecord> mesh_records_;       // per mesh, for the meshes of instanced objects
};

EmbreeScene EmbreeAccelerator::new_scene() const {
  EmbreeScene scene(rtcNewScene(device_.get()));
  // Watertight at shared edges: a ray cannot slip between two triangles of a closed mesh.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
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

EmbreeAccelerator::EmbreeAccelerator(const Scene& scene, HitFilter filter)
    : scene_(scene),
      filter_(filter),
      device_(rtcNewDevice(nullptr)),
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
    EmbreeScene& bottom = object_scenes_[instance.object] = new_scene();
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

std::unique_ptr<Accelerator> make_embree_accelerator(const Scene& scene, HitFilter filter) {
  return std::make_unique<EmbreeAccelerator>(scene, filter);
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

#include "core/light_sampler.h"

#include <cmath>

#include "core/color.h"
#include "core/emission.h"
#include "core/punctual.h"
#include "core/warp.h"

namespace candil {
namespace {

/// The point of a triangle as if a ray had hit it.
SurfacePoint point_on_triangle(const Scene& scene, std::uint32_t instance, std::uint32_t mesh, std::uint32_t triangle,
                               Vec2 barycentric) {
  Hit hit;
  hit.barycentric = barycentric;
  hit.instance = instance, hit.mesh = mesh, hit.triangle = triangle;
  return make_surface_point(scene, hit);
}

}  // namespace

LightSampler::LightSampler(const Scene& scene) : scene_(scene), environment_(scene.environment) {
  std::vector<float> powers;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Object& object = scene.objects[instance.object];
    instance_offset_.push_back(static_cast<std::uint32_t>(mesh_first_light_.size()));
    for (std::uint32_t m = object.first_mesh; m < object.first_mesh + object.mesh_count; ++m) {
      const Mesh& mesh = scene.meshes[m];
      const Material& material = scene.materials[mesh.material];
      mesh_first_light_.push_back(material.is_emissive() ? static_cast<std::uint32_t>(triangles_.size()) : invalid_id);
      if (!material.is_emissive()) continue;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const EmissiveTriangle& light = triangles_.emplace_back(emissive_triangle(i, m, t));
        powers.push_back((light.is_double_sided ? 2 : 1) * pi * light.area * mean_luminance(light));
      }
    }
  }
  const Bounds bounds = scene_bounds(scene);
  const float scene_radius = bounds.is_empty() ? 1 : glm::max(bounds.radius(), 1e-6f);  // empty: planes alone
  for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
    const bool is_light = scene.materials[scene.shapes[i].material].is_emissive();
    shape_light_.push_back(is_light ? static_cast<std::uint32_t>(shapes_.size()) : invalid_id);
    if (is_light) powers.push_back(shapes_.emplace_back(scene, i).power(scene_radius));
  }
  for (const PunctualLight& light : scene.punctual_lights) powers.push_back(punctual_power(light, scene_radius));
  if (environment_.is_present()) {
    // Flux through the disc that the scene shows to each direction.
    powers.push_back(environment_.mean_luminance() * 4 * pi * pi * sqr(scene_radius));
  }
  table_ = AliasTable(powers);
}

LightSampler::EmissiveTriangle LightSampler::emissive_triangle(std::uint32_t instance, std::uint32_t mesh_id,
                                                               std::uint32_t triangle) const {
  const Mesh& mesh = scene_.meshes[mesh_id];
  const Material& material = scene_.materials[mesh.material];
  const Affine& to_world = scene_.instances[instance].to_world;
  const Triangle t = mesh.triangles[triangle];
  const SurfacePoint center = point_on_triangle(scene_, instance, mesh_id, triangle, Vec2(1 / 3.0f));
  EmissiveTriangle light;
  const Vec3 edge_b = to_world.vector(mesh.positions[t.y] - mesh.positions[t.x]);
  const Vec3 edge_c = to_world.vector(mesh.positions[t.z] - mesh.positions[t.x]);
  light.corner = to_lanes(to_world.point(mesh.positions[t.x]));
  light.edge_b = to_lanes(edge_b);
  light.edge_c = to_lanes(edge_c);
  light.normal = to_lanes(center.normal_geometric);
  const float area = 0.5f * glm::length(glm::cross(edge_b, edge_c));
  light.area = area < infinity ? area : 0;
  light.offset = center.offset;
  light.instance = instance, light.mesh = mesh_id, light.triangle = triangle;
  light.is_uniform =
      !material.emission_texture.is_used() && !material.is_unlit && material.alpha_mode == AlphaMode::opaque;
  light.is_double_sided = material.is_double_sided;
  light.radiance = material.emission;
  return light;
}

Vec3 LightSampler::emission_at(const EmissiveTriangle& light, Vec2 barycentric, bool is_front) const {
  if (light.is_uniform) return light.radiance;
  const SurfacePoint on = point_on_triangle(scene_, light.instance, light.mesh, light.triangle, barycentric);
  const Material& material = scene_.materials[on.material];
  return emitted_radiance(scene_, on, is_front) * alpha_coverage(scene_, material, on.uv, on.color);
}

/// Mean luminance of what the front emits, from a fixed grid of points on the triangle.
float LightSampler::mean_luminance(const EmissiveTriangle& light) const {
  const int side = light.is_uniform ? 1 : 4;
  float sum = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Vec2 u = (Vec2(column, row) + 0.5f) / static_cast<float>(side);
      sum += luminance(emission_at(light, sample_triangle(u), true));
    }
  }
  return sum / static_cast<float>(side * side);
}

std::optional<LightSample> LightSampler::sample(const SurfacePoint& from, double u_pick, Vec2 u) const {
  const AliasTable::Sample picked = table_.sample(u_pick);
  const float choice = picked.probability;
  if (picked.index < triangles_.size()) return sample_emissive(triangles_[picked.index], from, u, choice);
  const std::size_t shape = picked.index - triangles_.size();
  if (shape < shapes_.size()) return shapes_[shape].sample(from, u, choice);
  const std::size_t punctual = shape - shapes_.size();
  if (punctual < scene_.punctual_lights.size()) {
    std::optional<LightSample> result = sample_punctual(scene_.punctual_lights[punctual], from);
    if (result) result->pdf = choice;
    return result;
  }
  return sample_environment(from, u, choice);
}

std::optional<LightSample> LightSampler::sample_emissive(const EmissiveTriangle& light, const SurfacePoint& from,
                                                         Vec2 u, float choice) const {
  std::optional<LightSample> result;  // filled in place: copies of it cost more than its arithmetic
  const Vec2 barycentric = sample_triangle(u);
  const Float4 on = light.corner + barycentric.x * light.edge_b + barycentric.y * light.edge_c;
  const Float4 position = to_lanes(from.position), normal_from = to_lanes(from.normal_geometric);
  const Float4 normal_of_sides = to_lanes(from.normal_of_sides());
  const Float4 towards = on - position;
  const float distance_squared = dot(towards, towards), cosine_times_distance = -dot(towards, light.normal);
  const bool is_front = cosine_times_distance > 0;
  if (cosine_times_distance == 0 || light.area == 0 || (!is_front && !light.is_double_sided)) return result;
  // Both ends step off their surface, towards each other's side. Far from a small light, the ray's end is as inexact as
  // its beginning.
  const float offset = glm::max(light.offset, from.offset);
  const float side = std::copysign(from.offset, dot(towards, normal_of_sides));
  const Float4 origin = position + side * normal_from;
  const Float4 ray = on + (is_front ? offset : -offset) * light.normal - origin;
  const float length = glm::sqrt(dot(ray, ray)), distance = glm::sqrt(distance_squared);
  if (!(length > 0)) return result;
  LightSample& sample = result.emplace();
  sample.wi = to_vec3(towards * (1 / distance));
  sample.radiance = emission_at(light, barycentric, is_front);
  sample.pdf = choice * distance_squared * distance / (std::abs(cosine_times_distance) * light.area);
  sample.shadow_ray = {to_vec3(origin), to_vec3(ray * (1 / length)), length};
  return result;
}

std::optional<LightSample> LightSampler::sample_environment(const SurfacePoint& from, Vec2 u, float choice) const {
  const EnvironmentLight::Sample direction = environment_.sample(u);
  if (!(direction.pdf > 0)) return std::nullopt;
  LightSample sample;
  sample.wi = direction.direction;
  sample.radiance = direction.radiance;
  sample.pdf = choice * direction.pdf;
  sample.shadow_ray = {offset_origin(from, sample.wi), sample.wi};
  return sample;
}

float LightSampler::pdf_hit(Vec3 from_position, const SurfacePoint& on) const {
  if (on.is_on_shape()) {
    const std::uint32_t shape = shape_light_[on.triangle];
    if (shape == invalid_id) return 0;
    const auto light = static_cast<std::uint32_t>(triangles_.size() + shape);
    return table_.probability(light) * shapes_[shape].pdf(from_position, on);
  }
  const std::uint32_t slot =
      instance_offset_[on.instance] + on.mesh - scene_.objects[scene_.instances[on.instance].object].first_mesh;
  if (mesh_first_light_[slot] == invalid_id) return 0;
  const std::uint32_t light = mesh_first_light_[slot] + on.triangle;
  const Vec3 towards = on.position - from_position;
  const float distance_squared = length_squared(towards);
  const float cosine_times_distance = std::abs(glm::dot(towards, on.normal_geometric));
  const float area = triangles_[light].area;
  if (cosine_times_distance == 0 || area == 0) return 0;
  return table_.probability(light) * distance_squared * glm::sqrt(distance_squared) / (cosine_times_distance * area);
}

float LightSampler::pdf_miss(Vec3 direction) const {
  if (!environment_.is_present()) return 0;
  return table_.probability(static_cast<std::uint32_t>(table_.size() - 1)) * environment_.pdf(direction);
}

}  // namespace candil

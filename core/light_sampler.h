/// Chooses lights for next-event estimation and tells how likely a direction found otherwise would have been chosen.
#pragma once

#include <vector>

#include "core/distribution.h"
#include "core/environment.h"
#include "core/light_sample.h"
#include "core/scene.h"
#include "core/shape_light.h"
#include "core/simd.h"
#include "core/surface.h"

namespace candil {

/// Picks one light with probability proportional to its estimated power (alias table), then a point on it or a
/// direction to it. The shading point is part of every call so that a light tree can take its place.
class LightSampler {
 public:
  explicit LightSampler(const Scene& scene);

  bool is_empty() const { return table_.size() == 0; }
  std::size_t light_count() const { return table_.size(); }

  /// Nothing when the sampled light cannot shine on the point (its back side, or outside of a spot's cone).
  std::optional<LightSample> sample(const SurfacePoint& from, double u_pick, Vec2 u) const;

  /// Density, 1/sr as seen from `from_position`, with which sample() would have found the emitter at `on`; 0 for a
  /// surface that is not a light. `from_position` is where the ray that found it started.
  float pdf_hit(Vec3 from_position, const SurfacePoint& on) const;
  /// The same for a direction that leaves the scene; 0 without an environment.
  float pdf_miss(Vec3 direction) const;

  const EnvironmentLight& environment() const { return environment_; }

 private:
  /// Everything in world space, so that a sample of a plain emitter reads nothing else.
  struct EmissiveTriangle {
    Float4 corner, edge_b, edge_c;
    Float4 normal;  // unit, front side
    Vec3 radiance;  // of the front, where it is the same all over
    float area;     // m2; 0: degenerate, never sampled
    float offset;   // metres, as SurfacePoint::offset
    std::uint32_t instance, mesh, triangle;
    bool is_uniform;  // no texture, no alpha, no vertex colour decides what is emitted
    bool is_double_sided;
  };
  EmissiveTriangle emissive_triangle(std::uint32_t instance, std::uint32_t mesh, std::uint32_t triangle) const;
  float mean_luminance(const EmissiveTriangle& light) const;
  Vec3 emission_at(const EmissiveTriangle& light, Vec2 barycentric, bool is_front) const;
  // `choice` is the probability with which the light was chosen.
  std::optional<LightSample> sample_emissive(const EmissiveTriangle& light, const SurfacePoint& from, Vec2 u,
                                             float choice) const;
  std::optional<LightSample> sample_environment(const SurfacePoint& from, Vec2 u, float choice) const;

  const Scene& scene_;
  EnvironmentLight environment_;
  std::vector<EmissiveTriangle> triangles_;
  std::vector<ShapeLight> shapes_;
  // Light ids: emissive triangles first, then emissive shapes, punctual lights, and the environment (if any).
  AliasTable table_;
  std::vector<std::uint32_t> instance_offset_;   // per instance, into mesh_first_light_
  std::vector<std::uint32_t> mesh_first_light_;  // per mesh of an instance, first light id or invalid_id
  std::vector<std::uint32_t> shape_light_;       // per shape of the scene, into shapes_ or invalid_id
};

}  // namespace candil

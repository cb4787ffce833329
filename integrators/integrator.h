/// What every integrator answers, and the table of them.
#pragma once

#include <span>

#include "core/sampler.h"
#include "integrators/render.h"

namespace candil {

/// One camera path.
struct PathSample {
  Vec3 radiance{0.0f};  ///< W/(sr m2) along the camera ray, premultiplied by alpha.
  float alpha = 0;      ///< 1 where the ray hit something.
};

/// Follows one camera ray. Adds the rays it shoots, the camera ray included, to `rays`.
using Integrator = PathSample (*)(const RenderContext&, const RenderSettings&, const Ray& camera_ray, const Sampler&,
                                  RayCounts& rays);

/// A camera ray and the random numbers of its path.
struct CameraSample {
  Ray ray;
  Sampler sampler;
};

/// Follows many camera rays, each as if it were alone. `results` is as long as `samples`.
using BatchIntegrator = void (*)(const RenderContext&, const RenderSettings&, std::span<const CameraSample> samples,
                                 std::span<PathSample> results, RayCounts& rays);

/// Unidirectional path tracing with next-event estimation and multiple importance sampling.
void trace_paths(const RenderContext&, const RenderSettings&, std::span<const CameraSample>, std::span<PathSample>,
                 RayCounts&);
PathSample trace_path(const RenderContext&, const RenderSettings&, const Ray&, const Sampler&, RayCounts&);
/// The same expected value without next-event estimation: lights are found by chance. The oracle of trace_path().
PathSample trace_naive(const RenderContext&, const RenderSettings&, const Ray&, const Sampler&, RayCounts&);
/// The estimator of the report that candil began from, to compare with: roulette between lobes and absorption,
/// next-event estimation for punctual lights alone, no weights. Paths end at emitters, which reflect nothing here;
/// otherwise the expected value is that of trace_path().
PathSample trace_classic(const RenderContext&, const RenderSettings&, const Ray&, const Sampler&, RayCounts&);
/// Shading normal of the first hit, world space, mapped from [-1, 1] to [0, 1].
PathSample show_normals(const RenderContext&, const RenderSettings&, const Ray&, const Sampler&, RayCounts&);
/// Albedo of the first hit's closure; emitters show as white.
PathSample show_albedo(const RenderContext&, const RenderSettings&, const Ray&, const Sampler&, RayCounts&);

BatchIntegrator integrator_function(IntegratorKind kind);

/// Sampler dimensions: the camera's, then four for each vertex (see VertexSamples); from the other end, what few paths
/// need.
namespace dimension {
inline constexpr std::uint32_t filter = 0, lens = 1, first_vertex = 2, per_vertex = 4;
inline constexpr std::uint32_t wavelength = ~std::uint32_t{0};
inline constexpr std::uint32_t first_medium = 0x80000000u;  // per_vertex for each step in a scattering medium
}  // namespace dimension

}  // namespace candil

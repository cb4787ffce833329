// Path tracing with next-event estimation and multiple importance sampling (Kajiya 1986; Veach 1997, chapter 9).
//
// A few paths move on together, vertex by vertex: all look for their next hit, then all are shaded, then all shadow
// rays are shot. What shading reads of a hit is fetched meanwhile, and each stage finds its code and branches warm.
// Paths know nothing of each other, and each computes exactly what it would compute alone.
#include <algorithm>
#include <array>
#include <new>

#include "core/emission.h"
#include "integrators/medium.h"

namespace candil {
namespace {

/// More hide no more latency, and leave the first-level cache.
constexpr std::size_t batch_size = 16;

/// One over the weight of a strategy with density `pdf` beside one with density `other` (power heuristic, beta = 2).
float inverse_mis_weight(float pdf, float other) {
  // Divided first: the squares of large densities overflow.
  const float ratio = other / pdf;
  return 1 + ratio * ratio;
}

/// Weight of light that the closure's own sample ran into.
float weight_of_found_light(const PathState& state, float light_pdf) {
  return state.is_specular ? 1.0f : 1 / inverse_mis_weight(state.bsdf_pdf, light_pdf);
}

/// A path, and what one stage leaves to the next.
struct Lane {
  PathState state;
  Ray shadow_ray;
  Vec3 shadow_radiance;  // what the path collects unless the shadow ray is blocked
};

/// Ids of lanes.
struct LaneList {
  std::array<std::uint8_t, batch_size> ids;
  std::size_t count = 0;

  void add(std::uint8_t lane) { ids[count++] = lane; }
  const std::uint8_t* begin() const { return ids.data(); }
  const std::uint8_t* end() const { return ids.data() + count; }
};

class Batch {
 public:
  Batch(const RenderContext& context, const RenderSettings& settings, RayCounts& rays)
      : context_(context), scene_(context.scene), settings_(settings), rays_(rays) {}

  /// At most batch_size paths.
  void trace(std::span<const CameraSample> samples, std::span<PathSample> results) {
    samples_ = samples;
    LaneList active;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      lanes_[i].state = {};
      lanes_[i].state.ray = samples[i].ray;
      results[i].alpha = 1;
      active.add(static_cast<std::uint8_t>(i));
    }
    rays_.camera += samples.size();
    while (active.count > 0) {
      LaneList walking, shadows;
      const LaneList hits = intersect(active, results, walking);
      active = walking;
      draw_numbers(hits);
      for (std::size_t k = 0; k < hits.count; ++k) {
        // In place: a copy would wait for the stores.
        ::new (&points_[k]) SurfacePoint(make_surface_point(scene_, hits_[k]));
      }
      for (std::size_t k = 0; k < hits.count; ++k) {
        if (shade(hits.ids[k], hits_[k].t, points_[k], numbers_[k], shadows)) active.add(hits.ids[k]);
      }
      trace_shadow_rays(shadows);
      rays_.bounce += active.count;
    }
    for (std::size_t i = 0; i < samples.size(); ++i) results[i].radiance = lanes_[i].state.radiance;
  }

 private:
  /// Moves the paths to their next surface; those that leave the scene get its background and are not returned. The hit
  /// of the k-th path returned is hits_[k]. Those that scatter in a medium on the way are `walking`.
  LaneList intersect(const LaneList& active, std::span<PathSample> results, LaneList& walking) {
    for (std::size_t k = 0; k < active.count; ++k) next_rays_[k] = lanes_[active.ids[k]].state.ray;
    find_hits(active.count);
    LaneList hits;
    for (std::size_t k = 0; k < active.count; ++k) {
      const std::uint8_t i = active.ids[k];
      PathState& state = lanes_[i].state;
      if (!hits_[k].is_miss()) {
        if (is_in_scattering_medium(state, scene_)) {
          const Medium medium = medium_of(scene_.materials[state.medium]);
          const MediumStep step = step_in_medium(state, medium, hits_[k].t, samples_[i].sampler);
          if (step == MediumStep::scattered) walking.add(i);
          if (step != MediumStep::surface) continue;
        }
        hits_[hits.count] = hits_[k];
        hits.add(i);
      } else if (state.bounce == 0 && settings_.transparent_background) {
        results[i].alpha = 0;
      } else {
        const float weight = weight_of_found_light(state, context_.lights.pdf_miss(state.ray.direction));
        state.radiance += state.throughput * background(context_, state) * weight;
      }
    }
    return hits;
  }

  /// Shoots the first `count` next_rays_, a group at a time: the triangles that one group hits are fetched while the
  /// next one is under way, and their vertices during the one after that.
  void find_hits(std::size_t count) {
    constexpr std::size_t group_size = 4;
    const auto for_hits = [&](std::size_t first, const auto& prefetch) {
      for (std::size_t k = first; k < std::min(first + group_size, count); ++k) {
        if (!hits_[k].is_miss()) prefetch(scene_, hits_[k]);
      }
    };
    for (std::size_t first = 0; first < count; first += group_size) {
      const std::size_t size = std::min(group_size, count - first);
      context_.accelerator.intersect_each(std::span(next_rays_).subspan(first, size),
                                          std::span(hits_).subspan(first, size));
      for_hits(first, prefetch_triangle);
      if (first > 0) for_hits(first - group_size, prefetch_surface_point);
    }
    for_hits((count - 1) / group_size * group_size, prefetch_surface_point);
  }

  void draw_numbers(const LaneList& hits) {
    for (std::size_t k = 0; k < hits.count; k += 2) {
      const std::uint8_t i = hits.ids[k], j = hits.ids[std::min(k + 1, hits.count - 1)];
      const auto both = VertexSamples::of_two({samples_[i].sampler, samples_[j].sampler},
                                              {lanes_[i].state.bounce, lanes_[j].state.bounce});
      numbers_[k] = both[0], numbers_[k + 1] = both[1];
    }
  }

  /// Collects what the surface emits, chooses a light, and turns the path to its next direction; false when it ends.
  bool shade(std::uint8_t i, float distance, SurfacePoint& point, const VertexSamples& u, LaneList& shadows) {
    Lane& lane = lanes_[i];
    PathState& state = lane.state;
    if (state.medium != invalid_id && !is_in_scattering_medium(state, scene_)) {
      state.throughput *= volume_transmittance(scene_, state.medium, distance);
    }
    const Vec3 wo = -state.ray.direction;
    const Vec3 emitted = emitted_radiance(scene_, point, glm::dot(wo, point.normal_geometric) > 0);
    if (!is_black(emitted)) {
      const float light_pdf = state.is_specular ? 0 : context_.lights.pdf_hit(state.from, point);
      state.radiance += state.throughput * emitted * weight_of_found_light(state, light_pdf);
    }
    if (state.bounce >= settings_.max_bounces) return false;

    face_viewer(point, wo);
    const Wavelength wavelength = wavelength_at(state, scene_, point, samples_[i].sampler);
    const Bsdf bsdf = make_bsdf(scene_, context_.tables, point, wo, wavelength);
    if (!bsdf.is_purely_delta() && !context_.lights.is_empty() && choose_light(lane, point, bsdf, wo, u)) {
      shadows.add(i);
    }
    return scatter(state, scene_, point, bsdf, u.lobe(), u.direction(), wavelength) &&
           survives_roulette(state, u.roulette());
  }

  /// Next-event estimation up to the shadow ray; false when no light can come this way.
  bool choose_light(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf, Vec3 wo, const VertexSamples& u) const {
    const std::optional<LightSample> light = context_.lights.sample(point, u.light_choice(), u.light());
    if (!light || is_black(light->radiance)) return false;
    const BsdfEval scattered = bsdf.eval(wo, light->wi);
    if (is_black(scattered.f_cos)) return false;
    const float inverse_weight = light->is_delta ? 1.0f : inverse_mis_weight(light->pdf, scattered.pdf);
    Vec3 radiance = scattered.f_cos * light->radiance * (1 / (light->pdf * inverse_weight));
    const std::uint32_t crossed = medium_beyond(scene_, point, wo, light->wi, lane.state.medium);
    if (crossed != invalid_id) radiance *= volume_transmittance(scene_, crossed, light->shadow_ray.t_max);
    lane.shadow_ray = light->shadow_ray;
    lane.shadow_radiance = lane.state.throughput * radiance;
    return true;
  }

  void trace_shadow_rays(const LaneList& shadows) {
    rays_.shadow += shadows.count;
    for (const std::uint8_t i : shadows) {
      Lane& lane = lanes_[i];
      if (!context_.accelerator.occluded(lane.shadow_ray)) lane.state.radiance += lane.shadow_radiance;
    }
  }

  const RenderContext& context_;
  const Scene& scene_;
  const RenderSettings& settings_;
  RayCounts& rays_;
  std::span<const CameraSample> samples_;
  std::array<Lane, batch_size> lanes_;
  // Of the paths in hand, without gaps.
  std::array<Ray, batch_size> next_rays_;
  std::array<Hit, batch_size> hits_;
  std::array<SurfacePoint, batch_size> points_;
  std::array<VertexSamples, batch_size> numbers_;
};

}  // namespace

void trace_paths(const RenderContext& context, const RenderSettings& settings, std::span<const CameraSample> samples,
                 std::span<PathSample> results, RayCounts& rays) {
  Batch batch(context, settings, rays);
  for (std::size_t first = 0; first < samples.size(); first += batch_size) {
    const std::size_t count = std::min(batch_size, samples.size() - first);
    batch.trace(samples.subspan(first, count), results.subspan(first, count));
  }
}

PathSample trace_path(const RenderContext& context, const RenderSettings& settings, const Ray& camera_ray,
                      const Sampler& sampler, RayCounts& rays) {
  const CameraSample sample{camera_ray, sampler};
  PathSample result;
  trace_paths(context, settings, {&sample, 1}, {&result, 1}, rays);
  return result;
}

}  // namespace candil

#include "integrators/camera_sampling.h"

namespace candil {
namespace {

constexpr std::size_t lane_count = 8;

/// Up to eight samples on their way through the vector registers; what is not filled holds some sample.
struct Group {
  explicit Group(const Sampler& any) : samplers{any, any, any, any, any, any, any, any} {}

  std::array<Sampler, lane_count> samplers;
  FloatLanes x{};  // of the pixels
  std::size_t count = 0;
};

}  // namespace

CameraSampling::CameraSampling(const Camera& camera, const RenderSettings& settings)
    : rays_(camera, settings.width, settings.height), filter_(settings.filter), seed_(settings.seed) {}

void CameraSampling::sample(const PixelRow& row, std::uint32_t first_sample, std::uint32_t count,
                            std::vector<CameraSample>& samples) const {
  samples.clear();
  Group group(Sampler({row.left, row.y}, first_sample, seed_));
  const auto flush = [&] {
    const auto [u, v] = Sampler::sample_2d(group.samplers, dimension::filter);
    const FloatLanes x = group.x + 0.5f + filter_.sample_1d(u);
    const FloatLanes y = static_cast<float>(row.y) + 0.5f + filter_.sample_1d(v);
    if (rays_.has_lens()) {
      const auto [lens_u, lens_v] = Sampler::sample_2d(group.samplers, dimension::lens);
      for (std::size_t i = 0; i < group.count; ++i)
        samples.push_back({rays_.ray({x[i], y[i]}, {lens_u[i], lens_v[i]}), group.samplers[i]});
    } else {
      const std::array<Ray, lane_count> rays = rays_.rays(x, y);
      for (std::size_t i = 0; i < group.count; ++i) samples.push_back({rays[i], group.samplers[i]});
    }
    group.count = 0;
  };
  for (int x = row.left; x < row.right; ++x) {
    const Sampler sampler({x, row.y}, 0, seed_);
    for (std::uint32_t i = 0; i < count; ++i) {
      group.samplers[group.count] = sampler.at_sample(first_sample + i);
      group.x[group.count] = static_cast<float>(x);
      if (++group.count == lane_count) flush();
    }
  }
  if (group.count > 0) flush();
}

}  // namespace candil

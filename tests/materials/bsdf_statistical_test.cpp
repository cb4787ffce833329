// Samples of every closure follow the density that it states (chi-square over the sphere; delta lobes have none, and
// what they take is what the density lacks).
#include <gtest/gtest.h>

#include "materials/bsdf.h"
#include "tests/support/chi_square.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

class BsdfSampling : public testing::TestWithParam<NamedMaterial> {};

TEST_P(BsdfSampling, FollowsPdf) {
  const ClosureBench bench(GetParam().material);
  for (const float angle : {5.0f, 60.0f, 80.0f, 88.0f, 93.0f, 125.0f}) {
    if (angle > 90 && !GetParam().material.is_transmissive()) continue;
    const Vec3 wo = direction_at(angle);
    const Bsdf bsdf = bench.bsdf(wo);
    const auto sample = [&](Random& random) -> std::optional<Vec3> {
      const float u_lobe = random.next_1d();
      const auto drawn = bsdf.sample(wo, u_lobe, random.next_2d());
      return drawn && !drawn->is_delta ? std::optional(drawn->wi) : std::nullopt;
    };
    const auto pdf = [&](Vec3 wi) { return bsdf.eval(wo, wi).pdf; };
    const ChiSquareResult result = test_directions(sample, pdf, 50000, 7, SphereGrid{12, 24});
    EXPECT_GT(result.p_value, significance)
        << "at " << angle << " degrees: chi-square " << result.statistic << " with " << result.degrees_of_freedom;
  }
}

INSTANTIATE_TEST_SUITE_P(Closures, BsdfSampling, testing::ValuesIn(rough_materials()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace candil::test

// Closures: made from a material, evaluated, sampled.
#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <vector>

#include "core/sampler.h"
#include "core/warp.h"
#include "materials/bsdf.h"

namespace candil {
namespace {

struct NamedMaterial {
  const char* name;
  Material material;
};

std::vector<NamedMaterial> materials() {
  Material diffuse, glossy, metal, glass, phong, gold;
  diffuse.metallic = 0, diffuse.specular = 0, diffuse.is_double_sided = true;
  glossy.metallic = 0, glossy.roughness = 0.3f;
  metal.metallic = 1, metal.roughness = 0.3f;
  glass.metallic = 0, glass.roughness = 0.2f, glass.transmission = 1, glass.thickness = 1;
  phong.model = MaterialModel::phong, phong.phong_exponent = 50;
  phong.base_color = Vec4(0.6f, 0.6f, 0.6f, 1), phong.specular_color = Vec3(0.2f);
  gold.model = MaterialModel::conductor, gold.roughness = 0.3f;
  return {{"diffuse", diffuse},   {"glossy", glossy}, {"metal", metal},
          {"rough glass", glass}, {"phong", phong},   {"conductor", gold}};
}

/// A closure has to be made for a scene; this one has a material and nothing else.
struct Surface {
  explicit Surface(const Material& material) : scene(make_scene(material)), tables(scene) {
    point.position = Vec3(0), point.normal_geometric = point.normal = Vec3(0, 0, 1);
    point.tangent = Vec4(1, 0, 0, 1);
  }
  static Scene make_scene(const Material& material) {
    Scene scene;
    scene.materials = {material};
    return scene;
  }
  Scene scene;
  BsdfTables tables;
  SurfacePoint point;
};

/// Random numbers and directions above the surface, more than a branch predictor learns.
constexpr std::size_t case_count = 4096;
struct Case {
  Vec3 wo, wi;
  Vec2 u, v;
};
const std::vector<Case>& cases() {
  static const std::vector<Case> list = [] {
    std::vector<Case> made;
    for (std::uint32_t i = 0; i < case_count; ++i) {
      const FourPoints numbers = Sampler({1, 2}, i, 3).sample_four_2d(0);
      made.push_back(
          {sample_cosine_hemisphere(numbers[0]), sample_cosine_hemisphere(numbers[1]), numbers[2], numbers[3]});
    }
    return made;
  }();
  return list;
}

void make(benchmark::State& state, const Material& material) {
  const Surface surface(material);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    Bsdf bsdf = make_bsdf(surface.scene, surface.tables, surface.point, cases()[i++ % case_count].wo);
    benchmark::DoNotOptimize(bsdf);
  }
}

void eval(benchmark::State& state, const Material& material) {
  const Surface surface(material);
  const Vec3 wo = cases()[7].wo;
  const Bsdf bsdf = make_bsdf(surface.scene, surface.tables, surface.point, wo);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    BsdfEval result = bsdf.eval(wo, cases()[i++ % case_count].wi);
    benchmark::DoNotOptimize(result);
  }
}

void sample(benchmark::State& state, const Material& material) {
  const Surface surface(material);
  const Vec3 wo = cases()[7].wo;
  const Bsdf bsdf = make_bsdf(surface.scene, surface.tables, surface.point, wo);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Case& c = cases()[i++ % case_count];
    std::optional<BsdfSample> result = bsdf.sample(wo, c.v.x, c.u);
    benchmark::DoNotOptimize(result);
  }
}

const int registered = [] {
  for (const auto& [name, material] : materials()) {
    const std::string suffix = std::string("/") + name;
    benchmark::RegisterBenchmark(("closure/make" + suffix).c_str(), make, material);
    benchmark::RegisterBenchmark(("closure/eval" + suffix).c_str(), eval, material);
    benchmark::RegisterBenchmark(("closure/sample" + suffix).c_str(), sample, material);
  }
  return 0;
}();

}  // namespace
}  // namespace candil

#include "tests/support/closure_bench.h"

#include <cmath>

#include "core/sampler.h"

namespace candil::test {
namespace {

Scene scene_of(const Material& material) {
  Scene scene;
  scene.materials = {material};
  return scene;
}

Scene scene_of(const std::vector<NamedMaterial>& materials) {
  Scene scene;
  for (const NamedMaterial& named : materials) scene.materials.push_back(named.material);
  return scene;
}

SurfacePoint point_in_plane(Vec3 normal) {
  SurfacePoint point;
  point.normal_geometric = Vec3(0, 0, 1);
  point.normal = normal;
  return point;
}

Material white(float roughness) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  return m;
}

Material metal(float roughness) {
  Material m = white(roughness);
  m.metallic = 1;
  return m;
}

Material glass(float roughness, float ior) {
  Material m = white(roughness);
  m.transmission = 1;
  m.thickness = 1;
  m.ior = ior;
  return m;
}

Material sheet(float roughness) {
  Material m = white(roughness);
  m.transmission = 1;
  return m;
}

Material translucent(float roughness, float share) {
  Material m = white(roughness);
  m.extensions.emplace().diffuse_transmission = share;
  return m;
}

/// As wide as a GGX lobe of that roughness, about: n = 2 / alpha^2 - 2.
Material phong(float roughness, Vec3 kd, Vec3 ks) {
  Material m;
  m.model = MaterialModel::phong;
  m.base_color = Vec4(kd, 1);
  m.specular_color = ks;
  m.phong_exponent = 2 / (roughness * roughness * roughness * roughness) - 2;
  return m;
}

Material conductor(float roughness, Vec3 eta, Vec3 k) {
  Material m;
  m.model = MaterialModel::conductor;
  m.roughness = roughness;
  m.conductor_eta = eta;
  m.conductor_k = k;
  return m;
}

Material specular_glossiness(float roughness, Vec3 diffuse, Vec3 specular) {
  Material m;
  m.model = MaterialModel::specular_glossiness;
  m.base_color = Vec4(diffuse, 1);
  m.roughness = roughness;
  m.specular_color = specular;
  return m;
}

Material with(Material m, void (*change)(Material&)) {
  change(m);
  return m;
}

/// KHR_materials_specular: weaker at grazing incidence, stronger than Fresnel's reflectance in red and weaker in blue.
Material coloured_specular(Material m) {
  m.specular = 0.7f;
  m.specular_color = Vec3(4, 1.5f, 0.2f);
  return m;
}

Material coated(Material m, float weight, float roughness) {
  if (!m.extensions) m.extensions.emplace();
  m.extensions->clearcoat = weight;
  m.extensions->clearcoat_roughness = roughness;
  return m;
}

/// A coat on top of everything that can lie below it, smooth ones included.
std::vector<NamedMaterial> coated_materials(float r) {
  return {
      {"coated_diffuse", coated(with(white(1), [](Material& m) { m.specular = 0; }), 1, r), true, false},
      {"coated_plastic", coated(white(0.4f), 1, r), true, false},
      {"coated_black", coated(with(white(0.4f), [](Material& m) { m.base_color = Vec4(0, 0, 0, 1); }), 1, r), false,
       false},
      {"coated_metal", coated(metal(0.3f), 1, r), true, false},
      {"coated_mirror", coated(metal(0), 1, r), true, false},
      {"coated_half_metal", coated(with(white(0.5f), [](Material& m) { m.metallic = 0.5f; }), 0.6f, r), true, false},
      {"coated_glass", coated(glass(0, 1.5f), 1, r), true, false},
      {"coated_rough_glass", coated(glass(0.4f, 1.5f), 1, r), true, false},
      {"coated_sheet", coated(sheet(0), 1, r), true, false},
      {"coated_specular_glass", coated(coloured_specular(glass(0.4f, 1.5f)), 1, r), true, false},
      {"coated_translucent", coated(translucent(0.4f, 0.5f), 1, r), true, false},
      {"smooth_coat_on_translucent", coated(translucent(r, 0.5f), 1, 0), true, false},
      {"smooth_coat_on_glass", coated(glass(r, 1.5f), 1, 0), true, false},
      {"coated_diamond", coated(glass(r, 2.42f), 1, 0.1f), true, false},
      {"coated_rough_sheet", coated(sheet(0.4f), 1, r), true, false},
      {"coated_half_transmissive_glass",
       coated(with(glass(0.3f, 1.5f), [](Material& m) { m.transmission = 0.5f; }), 0.5f, r), true, false},
  };
}

Material with_sheen(Material m, Vec3 color, float roughness) {
  if (!m.extensions) m.extensions.emplace();
  m.extensions->sheen_color = color;
  m.extensions->sheen_roughness = roughness;
  return m;
}

/// Sheen on top of everything that can lie below it, and below a coat.
std::vector<NamedMaterial> sheen_materials(float r) {
  const Vec3 white_sheen(1), red(0.8f, 0.2f, 0.1f);
  const Material diffuse = with(white(1), [](Material& m) { m.specular = 0; });
  const Material dark = with(white(0.4f), [](Material& m) { m.base_color = Vec4(0.1f, 0.1f, 0.1f, 1); });
  return {
      {"sheen_on_diffuse", with_sheen(diffuse, white_sheen, r), true, false},
      {"red_sheen_on_diffuse", with_sheen(diffuse, red, r), false, false},
      {"sheen_on_dark", with_sheen(dark, white_sheen, r), false, false},
      {"sheen_on_plastic", with_sheen(white(0.4f), Vec3(0.5f), r), true, false},
      {"sheen_on_metal", with_sheen(metal(0.3f), white_sheen, r), true, false},
      {"sheen_on_mirror", with_sheen(metal(0), white_sheen, r), true, false},
      {"sheen_on_glass", with_sheen(glass(0, 1.5f), white_sheen, r), true, false},
      {"sheen_on_rough_glass", with_sheen(glass(0.4f, 1.5f), white_sheen, r), true, false},
      {"sheen_on_sheet", with_sheen(sheet(0.4f), white_sheen, r), true, false},
      {"sheen_on_translucent", with_sheen(translucent(0.4f, 0.5f), white_sheen, r), true, false},
      {"coat_and_sheen_on_plastic", coated(with_sheen(white(0.4f), white_sheen, r), 1, 0.3f), true, false},
      {"smooth_coat_and_sheen_on_glass", coated(with_sheen(glass(0, 1.5f), Vec3(0.7f), r), 0.8f, 0), true, false},
  };
}

Material brushed(Material m) {
  if (!m.extensions) m.extensions.emplace();
  m.extensions->anisotropy = 0.7f;
  m.extensions->anisotropy_rotation = 0.4f;
  return m;
}

Material filmed(Material m, float ior, float thickness) {
  if (!m.extensions) m.extensions.emplace();
  m.extensions->iridescence = 1;
  m.extensions->iridescence_ior = ior;
  m.extensions->iridescence_thickness = thickness;
  return m;
}

std::vector<NamedMaterial> plain_materials(float r) {
  return {
      {"diffuse", with(white(r), [](Material& m) { m.specular = 0; }), true},
      {"plastic", white(r), true},
      {"grey_plastic", with(white(r), [](Material& m) { m.base_color = Vec4(0.2f, 0.5f, 0.7f, 1); })},
      {"coloured_specular", with(white(r),
                                 [](Material& m) {
                                   m.specular = 0.7f;
                                   m.specular_color = Vec3(1, 0.4f, 0.1f);
                                 })},
      {"high_ior_plastic", with(white(r), [](Material& m) { m.ior = 2.4f; }), true},
      {"white_metal", metal(r), true},
      {"gold", with(metal(r), [](Material& m) { m.base_color = Vec4(1.0f, 0.77f, 0.34f, 1); })},
      {"half_metal", with(white(r), [](Material& m) { m.metallic = 0.5f; }), true},
      {"glass", glass(r, 1.5f), true},
      {"diamond", glass(r, 2.42f), true},
      {"tinted_glass", with(glass(r, 1.33f), [](Material& m) { m.base_color = Vec4(0.3f, 0.9f, 0.5f, 1); })},
      {"weak_specular_glass", with(glass(r, 1.5f), [](Material& m) { m.specular = 0.3f; }), true},
      {"coloured_specular_glass", coloured_specular(glass(r, 1.5f)), true},
      {"coloured_specular_bubble", coloured_specular(glass(r, 1 / 1.5f)), true},
      {"sheet", sheet(r), true},
      {"tinted_sheet", with(sheet(r), [](Material& m) { m.base_color = Vec4(0.9f, 0.2f, 0.2f, 1); })},
      {"half_transmissive_sheet", with(sheet(r), [](Material& m) { m.transmission = 0.5f; }), true},
      {"half_transmissive_glass", with(glass(r, 1.5f), [](Material& m) { m.transmission = 0.4f; }), true},
      {"mirror_of_infinite_ior", glass(r, 0), true},
      {"bubble_in_glass", glass(r, 1 / 1.5f), true},
      {"bubble_in_diamond", with(glass(r, 1 / 2.42f), [](Material& m) { m.base_color = Vec4(0.9f, 0.8f, 0.7f, 1); })},
      {"translucent", translucent(r, 0.4f), true},
      {"translucent_volume", with(translucent(r, 1), [](Material& m) { m.thickness = 1; }), true},
      {"translucent_without_coat", with(translucent(r, 0.7f), [](Material& m) { m.specular = 0; }), true},
      {"half_transmissive_translucent", with(translucent(r, 0.5f), [](Material& m) { m.transmission = 0.5f; }), true},
      {"leaf", with(translucent(r, 0.6f),
                    [](Material& m) {
                      m.base_color = Vec4(0.1f, 0.4f, 0.05f, 1);
                      m.extensions->diffuse_transmission_color = Vec3(0.6f, 0.8f, 0.1f);
                      m.metallic = 0.2f;
                    })},
      {"phong", phong(r, Vec3(0.65f), Vec3(0.2f))},
      {"coloured_phong", phong(r, Vec3(0.1f, 0.2f, 0.6f), Vec3(0.9f, 0.5f, 0.3f))},
      {"conductor_gold", conductor(r, Vec3(0.188f, 0.544f, 1.332f), Vec3(3.403f, 2.231f, 1.869f))},
      {"conductor_tinted",
       with(conductor(r, Vec3(2.7f), Vec3(3.7f)), [](Material& m) { m.base_color = Vec4(0.9f, 0.5f, 0.2f, 1); })},
      {"specular_glossiness", specular_glossiness(r, Vec3(0.2f, 0.5f, 0.7f), Vec3(0.3f, 0.2f, 0.1f))},
      {"specular_glossiness_diffuse", specular_glossiness(r, Vec3(1), Vec3(0)), true},
      {"specular_glossiness_metal", specular_glossiness(r, Vec3(1), Vec3(1)), true},
      {"conductor_without_loss", conductor(r, Vec3(1e-3f), Vec3(30)), true},
      {"brushed_metal", brushed(metal(r)), true},
      {"brushed_half_metal", brushed(with(white(r), [](Material& m) { m.metallic = 0.5f; })), true},
      {"brushed_glass", brushed(glass(r, 1.5f)), true},
      {"brushed_specular_glass", brushed(coloured_specular(glass(r, 1.5f))), true},
      {"brushed_half_transmissive_sheet", brushed(with(sheet(r), [](Material& m) { m.transmission = 0.5f; })), true},
      {"filmed_plastic", filmed(white(r), 1.8f, 350)},
      {"filmed_gold",
       filmed(with(metal(r), [](Material& m) { m.base_color = Vec4(1.0f, 0.77f, 0.34f, 1); }), 1.3f, 400)},
      {"filmed_half_metal", filmed(with(white(r), [](Material& m) { m.metallic = 0.5f; }), 2.2f, 200)},
      {"filmed_glass", filmed(glass(r, 1.5f), 1.3f, 500), true},
      {"strongly_filmed_glass", filmed(glass(r, 1.5f), 2.2f, 150), true},
      {"filmed_specular_glass",
       with(filmed(coloured_specular(glass(r, 1.5f)), 1.8f, 300),
            [](Material& m) { m.extensions->iridescence = 0.5f; }),
       true},
      {"filmed_bubble", filmed(glass(r, 1 / 1.5f), 1.3f, 500), true},
      {"soap_sheet", filmed(with(sheet(r), [](Material& m) { m.ior = 1; }), 1.33f, 300), true},
      {"brushed_filmed_plastic", brushed(filmed(white(r), 1.33f, 600))},
      {"brushed_filmed_glass", brushed(filmed(glass(r, 1.5f), 1.8f, 300)), true},
  };
}

}  // namespace

std::vector<NamedMaterial> materials_of_roughness(float r) {
  std::vector<NamedMaterial> all = plain_materials(r);
  const auto add = [&](const std::vector<NamedMaterial>& more) { all.insert(all.end(), more.begin(), more.end()); };
  add(coated_materials(r));
  add(sheen_materials(r));
  return all;
}

std::vector<NamedMaterial> rough_materials() {
  std::vector<NamedMaterial> all;
  for (const float roughness : {0.25f, 0.5f, 1.0f}) {
    for (NamedMaterial m : materials_of_roughness(roughness)) {
      m.name += "_" + std::to_string(static_cast<int>(roughness * 100));
      all.push_back(m);
    }
  }
  for (const NamedMaterial& m : coated_materials(0)) {
    if (m.name != "coated_mirror" && m.name != "coated_glass" && m.name != "coated_sheet" &&
        !m.name.starts_with("smooth_coat_on")) {
      all.push_back(m);
    }
  }
  return all;
}

std::vector<NamedMaterial> smooth_materials() { return materials_of_roughness(0); }

ClosureBench::ClosureBench(const Material& material, Vec3 normal)
    : scene_(scene_of(material)), tables_(scene_), point_(point_in_plane(normal)) {}

ClosureBench::ClosureBench(const std::vector<NamedMaterial>& materials)
    : scene_(scene_of(materials)), tables_(scene_), point_(point_in_plane(Vec3(0, 0, 1))) {}

Vec3 furnace(const Bsdf& bsdf, Vec3 wo, std::uint32_t samples) {
  glm::dvec3 sum(0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const float u_lobe = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
    const auto sample = bsdf.sample(wo, u_lobe, Sampler({3, 5}, i, 11).sample_2d(1));
    if (sample) sum += glm::dvec3(sample->weight * sqr(sample->eta));
  }
  return Vec3(sum / static_cast<double>(samples));
}

Vec3 furnace(const Bsdf& bsdf, Vec3 wo, std::uint32_t samples, float least, float most) {
  const Vec3 energy = furnace(bsdf, wo, samples);
  return min_component(energy) > least && max_component(energy) < most ? energy : furnace(bsdf, wo, 16 * samples);
}

Vec3 direction_at(float degrees) {
  const float theta = glm::radians(degrees), phi = 0.7f;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace candil::test

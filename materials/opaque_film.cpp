#include "materials/opaque_film.h"

#include "materials/fresnel.h"

namespace candil {
namespace {

constexpr int node_count = FacetAngles::node_count;

template <typename Reflectance>
FilmCurve<Vec3> curve_of(Vec3 f90, const Reflectance& reflectance) {
  FilmCurve<Vec3> curve;
  curve.f0 = reflectance(1.0f);
  curve.f90 = f90;
  for (int i = 0; i < node_count; ++i) {
    const float cosine = FacetAngles::cosine(i);
    curve.deviations[i] = reflectance(cosine) - fresnel_schlick(curve.f0, curve.f90, cosine);
  }
  return curve;
}

}  // namespace

OpaqueFilm::OpaqueFilm(const ThinFilm& film, Vec3 coat_f0, Vec3 coat_f90, Vec3 metal_f0, float metallic)
    : film_(film),
      metallic_(metallic),
      coat_f0_(coat_f0),
      coat_f90_(coat_f90),
      metal_f0_(metal_f0),
      coat_ior_(ior_of_reflectance(coat_f0)) {
  // At grazing incidence a film reflects everything.
  if (metallic < 1) {
    coat_ = curve_of(glm::mix(coat_f90, Vec3(1), film.share), [&](float cosine) { return coat_reflectance(cosine); });
  }
  if (metallic > 0) metal_ = curve_of(Vec3(1), [&](float cosine) { return metal_reflectance(cosine); });
}

Vec3 OpaqueFilm::coat_reflectance(float cosine) const {
  return glm::mix(fresnel_schlick(coat_f0_, coat_f90_, cosine),
                  film_reflectance_on_dielectric(film_, coat_ior_, cosine), film_.share);
}

Vec3 OpaqueFilm::metal_reflectance(float cosine) const {
  return glm::mix(fresnel_schlick(metal_f0_, Vec3(1), cosine), film_reflectance_on_metal(film_, metal_f0_, cosine),
                  film_.share);
}

Vec3 OpaqueFilm::reflectance(float cosine) const {
  if (metallic_ == 0) return coat_reflectance(cosine);
  if (metallic_ == 1) return metal_reflectance(cosine);
  return glm::mix(coat_reflectance(cosine), metal_reflectance(cosine), metallic_);
}

FilmCurve<Vec3> OpaqueFilm::mixture() const {
  FilmCurve<Vec3> curve;
  curve.f0 = glm::mix(coat_.f0, metal_.f0, metallic_);
  curve.f90 = glm::mix(coat_.f90, metal_.f90, metallic_);
  for (int i = 0; i < node_count; ++i) {
    curve.deviations[i] = glm::mix(coat_.deviations[i], metal_.deviations[i], metallic_);
  }
  return curve;
}

FilmCurve<float> OpaqueFilm::greatest_of_coat() const {
  FilmCurve<float> curve;
  curve.f0 = max_component(coat_.f0);
  curve.f90 = max_component(coat_.f90);
  for (int i = 0; i < node_count; ++i) {
    const float cosine = FacetAngles::cosine(i);
    const Vec3 reflectance = fresnel_schlick(coat_.f0, coat_.f90, cosine) + coat_.deviations[i];
    curve.deviations[i] = max_component(reflectance) - fresnel_schlick(Vec3(curve.f0), Vec3(curve.f90), cosine).x;
  }
  return curve;
}

}  // namespace candil

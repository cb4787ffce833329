/// Fresnel's term of an opaque surface that a thin film may cover: what OpaqueLobes need to know of it.
#pragma once

#include "materials/facets.h"

namespace candil {

/// A reflectance by the cosine at facets: Schlick's curve from f0 to f90, and what deviates from it.
template <typename Value>
struct FilmCurve {
  Value f0{0.0f}, f90{0.0f};
  std::array<Value, FacetAngles::node_count> deviations{};  ///< At the nodes.

  Value mean() const {
    Value sum = f0 + (f90 - f0) / 21.0f;  // fresnel_schlick_average()
    for (int i = 0; i < FacetAngles::node_count; ++i) sum += FacetAngles::mean_weight(i) * deviations[i];
    return glm::clamp(sum, Value(0.0f), Value(1.0f));
  }
  /// Of all that is reflected towards a direction, from FacetAngles.
  Value deviation(const FacetAngles::Nodes& shares) const {
    Value sum(0.0f);
    for (int i = 0; i < FacetAngles::node_count; ++i) sum += shares[i] * deviations[i];
    return sum;
  }
};

class OpaqueFilm {
 public:
  /// Reflectances without the film, as in OpaqueParameters. The specification wants a film on each of the two, the coat
  /// and the metal, mixed by `metallic`.
  OpaqueFilm(const ThinFilm& film, Vec3 coat_f0, Vec3 coat_f90, Vec3 metal_f0, float metallic);

  /// At a facet.
  Vec3 reflectance(float cosine) const;
  const FilmCurve<Vec3>& coat() const { return coat_; }
  const FilmCurve<Vec3>& metal() const { return metal_; }
  FilmCurve<Vec3> mixture() const;
  /// The greatest channel of the coat at each cosine: the base gets what it leaves over, so that colours do not turn
  /// into their opposites below (the extension's rgb_mix()).
  FilmCurve<float> greatest_of_coat() const;
  /// The same at one cosine, exactly.
  float greatest_of_coat(float cosine) const { return max_component(coat_reflectance(cosine)); }

 private:
  Vec3 coat_reflectance(float cosine) const;
  Vec3 metal_reflectance(float cosine) const;

  ThinFilm film_;
  float metallic_;
  Vec3 coat_f0_, coat_f90_, metal_f0_, coat_ior_;
  FilmCurve<Vec3> coat_, metal_;
};

}  // namespace candil

/// Closures of materials without a scene around them, for tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "materials/bsdf.h"

namespace candil::test {

struct NamedMaterial {
  std::string name;
  Material material;
  bool is_lossless = false;   ///< Everything that comes in goes out again.
  bool is_reciprocal = true;  ///< The same with wo and wi exchanged.
};

/// One of every kind of closure: opaque, metallic, refracting, thin, mixtures, and layers on them. None has delta lobes
/// alone.
std::vector<NamedMaterial> rough_materials();
/// The same kinds, and some that are purely delta where they are smooth, of that perceptual roughness of the surface or
/// of the layers.
std::vector<NamedMaterial> materials_of_roughness(float roughness);
/// The same kinds with perfectly smooth surfaces.
std::vector<NamedMaterial> smooth_materials();

/// Makes closures of one material at a point in the plane z = 0, whose front is +z.
class ClosureBench {
 public:
  /// With another normal it is a point of which a normal map has bent the normal.
  explicit ClosureBench(const Material& material, Vec3 normal = Vec3(0, 0, 1));
  /// Of several materials, which share their tables: those take longer than many samples.
  explicit ClosureBench(const std::vector<NamedMaterial>& materials);
  Bsdf bsdf(Vec3 wo, const Wavelength& wavelength = {}) const {
    return make_bsdf(scene_, tables_, point_, wo, wavelength);
  }
  Bsdf bsdf_of(std::size_t material, Vec3 wo) const {
    SurfacePoint point = point_;
    point.material = static_cast<std::uint32_t>(material);
    return make_bsdf(scene_, tables_, point, wo);
  }
  const Material& material() const { return scene_.materials[0]; }

 private:
  Scene scene_;
  BsdfTables tables_;
  SurfacePoint point_;
};

/// Energy that leaves towards wo for radiance 1 from everywhere: the mean of weight x eta^2. Numbers that choose lobes
/// rise from sample to sample: each lobe gets consecutive points of one sequence, which fill its directions evenly.
Vec3 furnace(const Bsdf& bsdf, Vec3 wo, std::uint32_t samples);
/// The same. Where the samples say that a channel is not between `least` and `most`, sixteen times as many decide.
Vec3 furnace(const Bsdf& bsdf, Vec3 wo, std::uint32_t samples, float least, float most);

/// Unit vector with that angle from +z, in degrees, turned a little about it.
Vec3 direction_at(float degrees);

}  // namespace candil::test

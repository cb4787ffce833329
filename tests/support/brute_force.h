/// The plainest way to find what a ray hits: every triangle, one after the other, in double precision and in world
/// space. Judges the answers of accelerators, those of `brute` too: it shares no code with any of them, and knows how
/// far a right answer may be off.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/ray.h"
#include "core/scene.h"

namespace candil::test {

/// A triangle that a ray crosses, or passes so closely that float arithmetic may say so.
struct Crossing {
  double t = 0, t_error = 0;  ///< Metres along the ray, and how far a right answer in float may be off.
  Vec2 barycentric{0.0f};
  double barycentric_error = 0;
  std::uint32_t instance = 0, mesh = 0, triangle = 0;
  bool is_certain = false;  ///< Further than the error inside of the triangle's edges and the ray's interval.
};

class BruteForce {
 public:
  enum class BackFaces { visible, as_materials_say };

  /// `as_materials_say`: the back of a material that is neither double-sided nor transmissive is invisible. Knows no
  /// alpha.
  BruteForce(const Scene& scene, BackFaces back_faces);

  std::vector<Crossing> crossings(const Ray& ray) const;

  /// Nothing about the ray with these crossings was a matter of rounding: only one answer is right.
  static bool is_decided(const std::vector<Crossing>& crossings);
  /// What is wrong with an answer to the ray with these crossings; empty: it is right.
  static std::string complaint(const Ray& ray, const std::vector<Crossing>& crossings,
                               const std::optional<Hit>& answer);

 private:
  /// One triangle in world space.
  struct Face {
    glm::dvec3 a, b, c;
    bool is_back_invisible, is_mirrored;
    double conditioning;          // squared condition number of the instance's matrix, 1 in world space
    double instance_translation;  // length; 0 in world space
    bool is_world_space;
    std::uint32_t instance, mesh, triangle;
  };
  std::optional<Crossing> cross(const Ray& ray, const Face& face) const;

  std::vector<Face> faces_;
};

}  // namespace candil::test

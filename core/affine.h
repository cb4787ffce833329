/// An affine transform: what a glTF node matrix is once its last row is known to be 0 0 0 1.
#pragma once

#include "core/math.h"

namespace candil {

struct Affine {
  Mat3 linear{1.0f};  ///< Column-major, as GLM has it.
  Vec3 translation{0.0f};

  Vec3 point(Vec3 p) const { return linear * p + translation; }
  Vec3 vector(Vec3 v) const { return linear * v; }
};

/// `outer` applied after `inner`.
inline Affine operator*(const Affine& outer, const Affine& inner) {
  return {outer.linear * inner.linear, outer.point(inner.translation)};
}

/// Maps normals like M^-T, up to a positive factor, and needs no inverse: the cofactor matrix times the sign of the
/// determinant. A mirrored transform keeps the front side of a surface its front side, as the glTF specification
/// (section 3.7.4) wants by its winding rule.
template <typename T, glm::qualifier Q>
glm::mat<3, 3, T, Q> normal_matrix(const glm::mat<3, 3, T, Q>& m) {
  const glm::mat<3, 3, T, Q> cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return glm::dot(m[0], cofactor[0]) < 0 ? -cofactor : cofactor;
}

inline Affine inverse(const Affine& a) {
  const Mat3 linear = glm::inverse(a.linear);
  return {linear, -(linear * a.translation)};
}

}  // namespace candil

/// One property over time, as the samplers of glTF animations give it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace candil {

enum class Interpolation { step, linear, cubic_spline };

/// Keys in order of time. With a cubic spline each key has an in-tangent, a value and an out-tangent, otherwise a value
/// alone, `components` numbers each. All numbers are finite.
struct AnimationCurve {
  Interpolation interpolation = Interpolation::linear;
  bool is_rotation = false;  ///< Values are unit quaternions, x y z w: between two of them lies an arc.
  std::size_t components = 1;
  std::span<const float> times;  ///< Seconds, at least one, never decreasing.
  std::span<const float> values;
};

/// The value at that time; before the first key and after the last one it stands still (specification, section 3.11
/// and appendix C).
std::vector<double> evaluate(const AnimationCurve& curve, double seconds);

}  // namespace candil

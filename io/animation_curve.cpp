#include "io/animation_curve.h"

#include <algorithm>
#include <cmath>

namespace candil {

namespace {

using Values = std::vector<double>;

Values to_values(std::span<const float> source) { return {source.begin(), source.end()}; }

double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += a[c] * b[c];
  return sum;
}

/// factor_a * a + factor_b * b
Values mix(const Values& a, double factor_a, const Values& b, double factor_b) {
  Values sum(a.size());
  for (std::size_t c = 0; c < a.size(); ++c) sum[c] = factor_a * a[c] + factor_b * b[c];
  return sum;
}

void normalize(Values& quaternion) {
  const double length = std::sqrt(dot(quaternion, quaternion));
  if (!(length > 0)) return;  // who reads it says so
  for (double& value : quaternion) value /= length;
}

/// Spherical linear interpolation the short way round (Shoemake 1985, "Animating Rotation with Quaternion Curves";
/// appendix C.4).
Values slerp(Values a, Values b, double t) {
  normalize(a);
  normalize(b);
  const double cosine = dot(a, b), sign = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(std::abs(cosine), 1.0)), sine = std::sin(angle);
  constexpr double smallest_sine = 1e-6;  // below it the arc is straight to the last bit of a float
  Values result = sine < smallest_sine ? mix(a, 1 - t, b, sign * t)
                                       : mix(a, std::sin(angle * (1 - t)) / sine, b, sign * std::sin(angle * t) / sine);
  normalize(result);
  return result;
}

}  // namespace

std::vector<double> evaluate(const AnimationCurve& curve, double seconds) {
  const bool is_cubic = curve.interpolation == Interpolation::cubic_spline;
  const std::size_t parts = is_cubic ? 3 : 1;
  // Part 0, 1, 2 of a key of a spline: in-tangent, value, out-tangent.
  const auto part = [&](std::size_t key, std::size_t which) {
    return to_values(curve.values.subspan((key * parts + which) * curve.components, curve.components));
  };
  const auto value = [&](std::size_t key) { return part(key, is_cubic ? 1 : 0); };

  // The first key after the time; between two keys of the same time lies none.
  const auto after =
      static_cast<std::size_t>(std::upper_bound(curve.times.begin(), curve.times.end(), seconds) - curve.times.begin());
  if (after == 0) return value(0);
  const std::size_t key = after - 1;
  if (after == curve.times.size() || curve.interpolation == Interpolation::step || seconds == curve.times[key]) {
    return value(key);
  }
  const double duration = double(curve.times[after]) - double(curve.times[key]);
  const double t = (seconds - curve.times[key]) / duration;
  if (!is_cubic) {
    return curve.is_rotation ? slerp(value(key), value(after), t) : mix(value(key), 1 - t, value(after), t);
  }
  // Appendix C.5: a cubic Hermite spline whose tangents are per second.
  const double t2 = t * t, t3 = t2 * t;
  const Values values = mix(value(key), 2 * t3 - 3 * t2 + 1, value(after), -2 * t3 + 3 * t2);
  const Values tangents = mix(part(key, 2), duration * (t3 - 2 * t2 + t), part(after, 0), duration * (t3 - t2));
  Values result = mix(values, 1, tangents, 1);
  if (curve.is_rotation) normalize(result);
  return result;
}

}  // namespace candil

/// Tails of Student's distribution, as logarithms: the ones that matter are too small for anything else.
#pragma once

namespace candil {

/// log10 of the probability that |T| >= t for T of Student's distribution with `freedom` > 0 degrees of freedom
/// (infinity: the normal distribution), t >= 0. Relative error of the probability below 1 % as long as it is above
/// 1e-30, of its logarithm below 1 % beyond. Finite: t of infinity gives -1000.
double log10_student_tails(double t, double freedom);

/// log10 of the probability that a normal variable is z or more away from its mean, in standard deviations.
double log10_normal_tails(double z);

}  // namespace candil

/// Made by tests/metrics/flip_pairs.py with flip-evaluator 1.7; do not edit.
#pragma once

#include <array>

namespace candil::test {

/// The FLIP of a pair: its mean, its largest value, and that of the pixels (0, 0), (20, 18), (24, 20), (47, 39).
struct FlipReference {
  const char* name;
  bool is_linear;
  double mean, largest;
  std::array<double, 4> at;
};

inline constexpr std::array flip_references = {
    FlipReference{"noise", false, 0.452292, 0.965230, {0.616205, 0.364061, 0.382665, 0.962174}},
    FlipReference{"faint noise", false, 0.077549, 0.205040, {0.200390, 0.056018, 0.052004, 0.160322}},
    FlipReference{"gradient", false, 0.093731, 0.125110, {0.029800, 0.088888, 0.095721, 0.118676}},
    FlipReference{"disc", false, 0.113978, 0.960330, {0.000000, 0.052408, 0.168021, 0.000000}},
    FlipReference{"colour", false, 0.312210, 0.312210, {0.312210, 0.312210, 0.312210, 0.312210}},
    FlipReference{"lines", false, 0.280245, 0.567794, {0.050666, 0.205252, 0.048845, 0.454241}},
    FlipReference{"dark noise", false, 0.025801, 0.083561, {0.036982, 0.049808, 0.007996, 0.024857}},
    FlipReference{"spike", false, 0.003614, 0.551745, {0.000000, 0.002134, 0.551745, 0.000000}},
    FlipReference{"green and blue", false, 1.000000, 1.000000, {1.000000, 1.000000, 1.000000, 1.000000}},
    FlipReference{"range", true, 0.043652, 0.122564, {0.062562, 0.024460, 0.070701, 0.116968}},
    FlipReference{"slope", true, 0.161616, 0.221308, {0.120780, 0.156720, 0.161212, 0.095057}},
    FlipReference{"lamp", true, 0.078055, 0.961565, {0.000000, 0.228577, 0.425829, 0.000000}},
    FlipReference{"firefly", true, 0.000375, 0.070144, {0.000000, 0.000360, 0.070144, 0.000000}},
    FlipReference{"mostly black", true, 0.150428, 0.897751, {0.000000, 0.010755, 0.016940, 0.475977}},
    FlipReference{"constant", true, 0.144833, 0.144833, {0.144833, 0.144833, 0.144833, 0.144833}},
    FlipReference{"dim", true, 0.147510, 0.398388, {0.370675, 0.070066, 0.158367, 0.398388}},
    FlipReference{"negative", true, 0.428508, 0.893581, {0.804526, 0.481969, 0.275360, 0.797901}},
};

}  // namespace candil::test

#include "metrics/sign_test.h"

#include <algorithm>
#include <cmath>

namespace candil {
namespace {

constexpr int smallest_side = 4;

struct Sums {
  double sum = 0, squares = 0;
  int count = 0;  // of values that are not 0

  void add(const Sums& other) { sum += other.sum, squares += other.squares, count += other.count; }
};

/// (b - a) / (b + a), 0 for what is equal or cannot be told.
double relative_difference(float a, float b, float rounding) {
  if (!(a >= 0 && b >= 0) || !std::isfinite(a) || !std::isfinite(b)) return 0;
  const double difference = static_cast<double>(b) - a;
  if (std::abs(difference) <= static_cast<double>(rounding) * std::max(a, b)) return 0;
  return difference / (static_cast<double>(a) + b);
}

/// Squares of one size.
struct Level {
  int side = 1, columns = 0, rows = 0;
  std::vector<Sums> squares;  // 3 for each
};

Level single_pixels(const ImagePair& pair, const PixelSelection& selection, float rounding) {
  Level level{1, pair.width(), pair.height(), {}};
  level.squares.resize(static_cast<std::size_t>(level.columns) * level.rows * 3);
  for (int y = 0; y < level.rows; ++y)
    for (int x = 0; x < level.columns; ++x) {
      if (!selection.contains(x, y)) continue;
      for (int c = 0; c < 3; ++c) {
        const double s = relative_difference(pair.a.pixel(x, y)[c], pair.b.pixel(x, y)[c], rounding);
        level.squares[(static_cast<std::size_t>(y) * level.columns + x) * 3 + c] = {s, s * s, s != 0};
      }
    }
  return level;
}

Level joined(const Level& fine) {
  Level level{fine.side * 2, (fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
  level.squares.resize(static_cast<std::size_t>(level.columns) * level.rows * 3);
  for (int y = 0; y < fine.rows; ++y)
    for (int x = 0; x < fine.columns; ++x)
      for (int c = 0; c < 3; ++c)
        level.squares[(static_cast<std::size_t>(y / 2) * level.columns + x / 2) * 3 + c].add(
            fine.squares[(static_cast<std::size_t>(y) * fine.columns + x) * 3 + c]);
  return level;
}

}  // namespace

SignTest measure_sign_test(const ImagePair& pair, const PixelSelection& selection, float rounding) {
  SignTest result;
  Level level = single_pixels(pair, selection, rounding);
  std::size_t tests = 0;
  const auto visit = [&] {
    for (std::size_t i = 0; i < level.squares.size(); ++i) {
      const Sums& sums = level.squares[i];
      if (sums.count == 0) continue;
      ++tests;
      const double z = sums.sum / std::sqrt(sums.squares);
      if (std::abs(z) <= std::abs(result.z)) continue;
      const auto square = static_cast<int>(i / 3);
      const int x = square % level.columns * level.side, y = square / level.columns * level.side;
      result.region = {x, y, std::min(level.side, pair.width() - x), std::min(level.side, pair.height() - y)};
      result.channel = static_cast<int>(i % 3);
      result.z = z;
    }
  };
  if (level.columns == 1 && level.rows == 1) visit();
  while (level.columns > 1 || level.rows > 1) {
    level = joined(level);
    if (level.side >= smallest_side || (level.columns == 1 && level.rows == 1)) visit();
  }
  if (tests == 0) return result;
  // 2 exp(-z^2 / 2) for each of the tests.
  const double log_p = std::log(2.0 * static_cast<double>(tests)) - result.z * result.z / 2;
  result.log10_p_value = std::min(log_p / std::log(10.0), 0.0);
  result.p_value = std::pow(10.0, result.log10_p_value);
  return result;
}

}  // namespace candil

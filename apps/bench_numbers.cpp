#include "apps/bench_numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace candil {
namespace {

/// Three digits that count, without an exponent.
std::string three_digits(double value) {
  const double size = std::abs(value);
  const int decimals = size >= 99.95 ? 0 : size >= 9.995 ? 1 : size >= 0.9995 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string with_thousands(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (int i = static_cast<int>(text.size()) - 3; i > 0; i -= 3) text.insert(static_cast<std::size_t>(i), ",");
  return text;
}

std::string in_seconds(double seconds) {
  if (seconds >= 0.9995) return three_digits(seconds) + " s";
  if (seconds >= 0.9995e-3) return three_digits(seconds * 1e3) + " ms";
  return three_digits(seconds * 1e6) + " us";
}

std::string in_bytes(double bytes) {
  if (bytes >= 0.9995e9) return three_digits(bytes / 1e9) + " GB";
  if (bytes >= 0.9995e6) return three_digits(bytes / 1e6) + " MB";
  if (bytes >= 0.9995e3) return three_digits(bytes / 1e3) + " kB";
  return fmt::format("{:.0f} B", bytes);
}

std::string in_millions(double rate) { return three_digits(rate / 1e6); }

}  // namespace candil

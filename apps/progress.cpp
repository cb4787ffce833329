#include "apps/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace candil {
namespace {

constexpr double seconds_between_lines = 10, seconds_between_redraws = 0.1;
constexpr int bar_width = 24;

bool is_terminal() {
  const char* const name = std::getenv("TERM");
  return isatty(STDERR_FILENO) && name && std::string_view(name) != "dumb";
}

/// 1234567 -> "1.23 M".
std::string with_magnitude(double value) {
  if (value >= 1e6) return fmt::format("{:.2f} M", value / 1e6);
  return value >= 1e3 ? fmt::format("{:.1f} k", value / 1e3) : fmt::format("{:.0f} ", value);
}

/// Minutes and seconds, with hours where there are any.
std::string clock_time(double seconds) {
  const auto total = static_cast<long>(std::lround(std::min(seconds, 3.6e8)));
  if (total < 3600) return fmt::format("{}:{:02}", total / 60, total % 60);
  return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
}

std::string bar(double fraction) {
  const int filled = static_cast<int>(fraction * bar_width);
  return "[" + std::string(filled, '=') + std::string(bar_width - filled, ' ') + "]";
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(bool is_quiet, const RenderSettings& settings)
    : kind_(is_quiet        ? Kind::none
            : is_terminal() ? Kind::terminal
                            : Kind::plain),
      settings_(settings) {
  if (kind_ == Kind::plain) next_update_seconds_ = seconds_between_lines;
}

void Progress::start(const std::string& scene_name) {
  if (kind_ != Kind::plain) return;
  const std::string goal = settings_.time_limit_seconds > 0 ? fmt::format("{:g} seconds", settings_.time_limit_seconds)
                                                            : fmt::format("{} spp", settings_.samples_per_pixel);
  print(fmt::format("rendering {}: {}x{}, {}, {} threads\n", scene_name, settings_.width, settings_.height, goal,
                    settings_.threads));
}

double Progress::fraction(const RenderProgress& progress) const {
  double fraction = progress.fraction_done;
  if (settings_.time_limit_seconds > 0) fraction = std::max(fraction, progress.seconds / settings_.time_limit_seconds);
  return std::clamp(fraction, 0.0, 1.0);
}

std::string Progress::describe(const RenderProgress& progress) const {
  const double done = fraction(progress);
  std::string text = fmt::format("{:3.0f} %  {} spp  {}samples/s", 100 * done, progress.samples_done,
                                 with_magnitude(progress.samples_per_second));
  if (progress.relative_noise > 0) text += fmt::format("  noise {:.2g} %", 100 * progress.relative_noise);
  // The first moments tell nothing about the rest.
  if (done > 0.001 && progress.seconds > 0.5)
    text += fmt::format("  {} left", clock_time(progress.seconds * (1 - done) / done));
  return text;
}

void Progress::update(const RenderProgress& progress) {
  if (kind_ == Kind::none || progress.seconds < next_update_seconds_) return;
  const bool is_terminal_line = kind_ == Kind::terminal;
  next_update_seconds_ = progress.seconds + (is_terminal_line ? seconds_between_redraws : seconds_between_lines);
  print(is_terminal_line ? "\r" + bar(fraction(progress)) + " " + describe(progress) + "\x1b[K"
                         : describe(progress) + "\n");
}

void Progress::finish() {
  if (kind_ == Kind::terminal) print("\r\x1b[K");
}

}  // namespace candil

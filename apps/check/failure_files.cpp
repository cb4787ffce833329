#include "apps/check/failure_files.h"

#include <algorithm>
#include <cmath>

#include "io/atomic_file.h"
#include "io/error.h"
#include "metrics/color_map.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

constexpr const char* file_names[] = {"render.exr", "golden.exr", "render.png", "golden.png",
                                      "heat.png",   "change.png", "command.txt"};

std::string commands(const TestOutcome& outcome) {
  return "# " + outcome.message + "\n" + outcome.reproduce + "\n# If the new picture is the right one:\n" +
         outcome.bless + "\n";
}

}  // namespace

std::vector<std::byte> shown_png(const Image& linear, const std::optional<DisplayRequest>& request) {
  const DisplayRequest wanted = request.value_or(DisplayRequest{make_tonemap(TonemapKind::neutral)});
  return encode_png(to_display(linear, wanted.exposure, wanted.tonemap), linear.channels == 4);
}

std::vector<std::byte> heat_png(const Image& flip_map) { return encode_png(heat_map(flip_map), false); }

std::vector<std::byte> change_png(const Image& a, const Image& b) {
  constexpr double full = 0.02;
  Image shown(a.width, a.height, 3);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const float *p = a.pixel(x, y), *q = b.pixel(x, y);
      const double of_a = static_cast<double>(p[0]) + p[1] + p[2], of_b = static_cast<double>(q[0]) + q[1] + q[2];
      const double change = std::max(of_a, of_b) > 0 ? 2 * (of_b - of_a) / (of_a + of_b) : 0;
      const auto strength = static_cast<float>(std::min(std::abs(change) / full, 1.0));
      const float pale = 1 - strength;
      float* const pixel = shown.pixel(x, y);
      pixel[0] = change > 0 ? 1 : pale, pixel[1] = pale, pixel[2] = change > 0 ? pale : 1;
    }
  return encode_png(shown, false);
}

void leave_failure_files(const fs::path& output, const TestOutcome& outcome) {
  const fs::path folder = output / outcome.test->name;
  std::error_code status;
  for (const char* name : file_names) fs::remove(folder / name, status);
  fs::remove(folder, status);  // as long as nothing else is in it
  if (!outcome.is_failure()) return;
  fs::create_directories(folder, status);
  if (status) throw OutputError(folder.string(), status.message());
  write_file_atomically(folder / "command.txt", commands(outcome));
  if (outcome.render && !outcome.render->image.mean.empty()) {
    write_golden(folder / "render.exr", outcome.render->image);
    write_file_atomically(folder / "render.png", shown_png(outcome.render->image.mean, outcome.render->display));
  }
  if (outcome.golden) {
    write_golden(folder / "golden.exr", *outcome.golden);
    write_file_atomically(folder / "golden.png", shown_png(outcome.golden->mean, outcome.render->display));
  }
  if (outcome.verdict && outcome.verdict->flip_map) {
    write_file_atomically(folder / "heat.png", heat_png(*outcome.verdict->flip_map));
    write_file_atomically(folder / "change.png", change_png(outcome.golden->mean, outcome.render->image.mean));
  }
}

}  // namespace candil

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/bench_numbers.h"
#include "apps/bench_report.h"

namespace candil {
namespace {

constexpr float margin = 16, axis_width = 44, line_height = 18;
constexpr float bar_width = 28, group_gap = 30, least_group_width = 112, panel_height = 180, panel_gap = 58;
constexpr ChartColor grid_color{221, 221, 221}, frame_color{102, 102, 102}, whisker_color{51, 51, 51};

/// Of the contestants in their order; further ones begin again. Told apart also by who confuses red and green (Okabe
/// and Ito 2008, "Color Universal Design").
constexpr std::array<ChartColor, 7> bar_colors = {
    ChartColor{0, 114, 178},  ChartColor{230, 159, 0}, ChartColor{0, 158, 115},  ChartColor{204, 121, 167},
    ChartColor{86, 180, 233}, ChartColor{213, 94, 0},  ChartColor{153, 153, 153}};

ChartColor bar_color(std::size_t contestant) { return bar_colors[contestant % bar_colors.size()]; }

/// 1, 2 or 5 times a power of ten, so that about five of them make `range`.
double grid_step(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 5)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (range / (factor * power) <= 5.5) return factor * power;
  return 10 * power;
}

std::string file_name(const BenchedScene& scene) { return scene.file.filename().string(); }

class BarChart {
 public:
  explicit BarChart(const BenchReport& report) : report_(report) {
    thread_index_ =
        static_cast<std::size_t>(std::ranges::max_element(report.options.threads) - report.options.threads.begin());
    group_width_ = std::max(least_group_width, group_gap + bars_width());
    chart_.width = 2 * margin + axis_width + group_width_ * static_cast<float>(ray_kind_count);
  }

  Chart draw() {
    float y = margin + line_height;
    const int threads = report_.options.threads[thread_index_];
    write(margin, y,
          fmt::format("Mrays/s with {} thread{}; lines from lowest to highest", threads, threads == 1 ? "" : "s"));
    write(margin, y += line_height, report_.machine.processor);
    y = draw_legend(y + line_height);
    for (const BenchedScene& scene : report_.scenes) {
      y += panel_gap;
      draw_panel(scene, y);
      y += panel_height;
    }
    chart_.height = y + margin + line_height;
    return std::move(chart_);
  }

 private:
  /// Of all contestants for one kind of ray.
  float bars_width() const { return bar_width * static_cast<float>(report_.options.accelerators.size()); }

  void write(float x, float y, const std::string& text, Chart::Anchor anchor = Chart::Anchor::left) {
    chart_.texts.push_back({x, y, anchor, text});
    if (anchor == Chart::Anchor::left) chart_.width = std::max(chart_.width, x + chart_text_width(text) + margin);
  }

  float draw_legend(float y) {
    float x = margin;
    for (std::size_t c = 0; c < report_.options.accelerators.size(); ++c) {
      const std::string& name = report_.options.accelerators[c].name;
      const float width = chart_text_width(name) + 34;
      if (x > margin && x + width > chart_.width - margin) x = margin, y += line_height;
      chart_.rectangles.push_back({x, y - 10, 12, 12, bar_color(c)});
      write(x + 18, y, name);
      x += width;
    }
    return y;
  }

  const RayRate& rate(const BenchedScene& scene, std::size_t contestant, RayKind kind) const {
    return scene.result.contestants[contestant].rates[thread_index_][kind];
  }

  double highest_rate(const BenchedScene& scene) const {
    double highest = 0;
    for (std::size_t c = 0; c < scene.result.contestants.size(); ++c)
      for (const RayKind kind : ray_kinds) highest = std::max(highest, rate(scene, c, kind).rays_per_second.max);
    return highest > 0 ? highest : 1;
  }

  void draw_panel(const BenchedScene& scene, float top) {
    const float left = margin + axis_width, bottom = top + panel_height;
    const float width = group_width_ * static_cast<float>(ray_kind_count);
    const double highest = highest_rate(scene), step = grid_step(highest);
    const auto height_of = [&](double value) { return static_cast<float>(value / highest) * panel_height; };
    write(margin, top - line_height, file_name(scene));
    for (int i = 0; i * step <= highest; ++i) {
      const float y = bottom - height_of(i * step);
      chart_.rectangles.push_back({left, y - 0.5f, width, 1, i == 0 ? frame_color : grid_color});
      write(left - 6, y + 4, fmt::format("{:g}", i * step / 1e6), Chart::Anchor::right);
    }
    for (std::size_t k = 0; k < ray_kind_count; ++k) {
      const float group = left + group_width_ * static_cast<float>(k);
      write(group + 0.5f * group_width_, bottom + line_height, ray_kind_name(ray_kinds[k]), Chart::Anchor::middle);
      for (std::size_t c = 0; c < scene.result.contestants.size(); ++c) {
        const Spread& s = rate(scene, c, ray_kinds[k]).rays_per_second;
        const float x = group + 0.5f * (group_width_ - bars_width()) + bar_width * static_cast<float>(c);
        const float middle = x + 0.5f * bar_width, height = height_of(s.median);
        chart_.rectangles.push_back({x + 2, bottom - height, bar_width - 4, height, bar_color(c)});
        chart_.rectangles.push_back(
            {middle - 0.5f, bottom - height_of(s.max), 1, height_of(s.max - s.min), whisker_color});
        write(middle, bottom - height_of(s.max) - 4, in_millions(s.median), Chart::Anchor::middle);
      }
    }
  }

  const BenchReport& report_;
  std::size_t thread_index_ = 0;
  float group_width_ = 0;
  Chart chart_;
};

}  // namespace

Chart bench_chart(const BenchReport& report) { return BarChart(report).draw(); }

}  // namespace candil

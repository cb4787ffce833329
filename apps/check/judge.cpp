#include "apps/check/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/map_statistics.h"
#include "metrics/sign_test.h"

namespace candil {
namespace {

/// Two renders of other seeds differ by about as much as the golden image and its sibling did; a picture of a few
/// thousand pixels by a few percent more or less. Half as much again is far beyond chance.
constexpr double flip_noise_factor = 1.5, flip_allowance = 0.01;
/// Without a sibling to tell the noise: what a person hardly sees.
constexpr double default_flip = 0.05;
/// Of a display value, which is in [0, 1]: half a step of 8 bits. The operator sees the same rounded input, so that
/// only its own arithmetic and the rounding to 11 bits are left.
constexpr double display_tolerance = 0.5 / 255;

Finding p_value_finding(std::string name, double p, double log10_p, double limit) {
  Finding finding{std::move(name), p, limit, log10_p, true, p >= limit};
  // A limit of 0 switches the test off, one of 1 is never met by chance.
  if (limit > 0) finding.severity = log10_p / std::min(std::log10(limit), -1e-3);
  return finding;
}

Finding upper_finding(std::string name, double value, double limit) {
  Finding finding{std::move(name), value, limit, 0, false, value <= limit};
  finding.severity = limit > 0 ? value / limit : value > 0 ? std::numeric_limits<double>::infinity() : 0;
  return finding;
}

Finding other_finding(const Judgement& judgement) {
  const auto [measure, limit] = judgement.threshold;
  const double value = judgement.value.value_or(std::numeric_limits<double>::quiet_NaN());
  Finding finding = upper_finding(measure_name(measure), value, limit);
  finding.is_smallest = is_better_when_larger(measure.metric);
  finding.is_met = judgement.is_met;
  if (finding.is_smallest) finding.severity = value > 0 ? limit / value : std::numeric_limits<double>::infinity();
  if (!finding.is_met) finding.severity = std::max(finding.severity, 1.0);
  return finding;
}

std::string place_note(const std::string& test, const Region& region, int channel, double deviation) {
  return fmt::format("{}: {} in {} x {} pixels from ({}, {}), channel {}, {:.1f} standard errors", test,
                     deviation > 0 ? "brighter" : "darker", region.width, region.height, region.x, region.y,
                     "RGB"[channel], std::abs(deviation));
}

double mean_change(const Image& a, const Image& b) {
  double sum_a = 0, sum_b = 0;
  const std::size_t pixels = a.pixels.size() / static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) sum_a += a.pixels[i * a.channels + c], sum_b += b.pixels[i * b.channels + c];
  return sum_a > 0 ? sum_b / sum_a - 1 : 0;
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a.pixels[i]) - b.pixels[i]));
  return largest;
}

/// The operator is held against what it made of the same values when the golden image was made: no noise in between.
void judge_display(const GoldenImage& golden, const DisplayRequest& request, Verdict& verdict) {
  if (!golden.display) {
    verdict.failure = "the golden image has no display layer, which the operator of the test needs";
    return;
  }
  const Image now = to_display(golden.mean, request.exposure, request.tonemap);
  if (now.channels != golden.display->channels || now.pixels.size() != golden.display->pixels.size()) {
    verdict.failure = "the display layer of the golden image has other channels";
    return;
  }
  verdict.findings.push_back(upper_finding("display", largest_difference(*golden.display, now), display_tolerance));
}

CompareSettings compare_settings(const CheckThresholds& thresholds) {
  CompareSettings settings;
  settings.z_test.rounding = golden_step;
  settings.with_ssim = std::ranges::any_of(
      thresholds.others, [](const Threshold& threshold) { return threshold.measure.metric == Metric::ssim; });
  return settings;
}

void judge_pixels(const GoldenImage& golden, const GoldenImage& render, const CheckThresholds& thresholds,
                  Verdict& verdict) {
  const ImagePair pair{golden.mean, render.mean, ValueKind::linear};
  const PixelSelection selection(pair.width(), pair.height());
  const PairVariance variance{{golden.variance, golden.samples}, {render.variance, render.samples}};
  const Comparison comparison = compare_images(pair, selection, compare_settings(thresholds), variance);
  const ZTest& z_test = *comparison.z_test;
  verdict.findings.push_back(p_value_finding("ztest", z_test.p_value, z_test.log10_p_value, thresholds.z_test));
  if (!verdict.findings.back().is_met)
    verdict.notes.push_back(place_note("ztest", z_test.worst.region, z_test.worst.channel, z_test.worst.deviation));
  if (golden.samples == render.samples) {
    const SignTest signs = measure_sign_test(pair, selection, golden_step * 1.001f);
    verdict.findings.push_back(p_value_finding("signs", signs.p_value, signs.log10_p_value, thresholds.sign_test));
    if (!verdict.findings.back().is_met)
      verdict.notes.push_back(place_note("signs", signs.region, signs.channel, signs.z));
  } else {
    verdict.notes.push_back(
        fmt::format("{} samples per pixel, the golden image has {}", render.samples, golden.samples));
  }
  const double flip = map_mean(comparison.flip->map, selection);
  const double noise_limit = golden.flip_noise ? flip_noise_factor * *golden.flip_noise + flip_allowance : default_flip;
  verdict.findings.push_back(upper_finding("flip", flip, thresholds.flip.value_or(noise_limit)));
  verdict.flip_map = comparison.flip->map;
  for (const Judgement& judgement : judge(comparison, thresholds.others))
    verdict.findings.push_back(other_finding(judgement));
}

}  // namespace

bool Verdict::is_passed() const { return failure.empty() && std::ranges::all_of(findings, &Finding::is_met); }

double Verdict::severity() const {
  if (!failure.empty()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const Finding& finding : findings) {
    if (std::isnan(finding.severity)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, finding.severity);
  }
  return largest;
}

Verdict judge_render(const GoldenImage& golden, const GoldenImage& render, const CheckThresholds& thresholds,
                     const std::optional<DisplayRequest>& request) {
  Verdict verdict;
  if (golden.mean.width != render.mean.width || golden.mean.height != render.mean.height) {
    verdict.failure = fmt::format("{}x{} pixels, the golden image has {}x{}", render.mean.width, render.mean.height,
                                  golden.mean.width, golden.mean.height);
    return verdict;
  }
  if (golden.mean.channels != render.mean.channels) {
    verdict.failure =
        golden.mean.channels == 4 ? "no alpha, the golden image has it" : "alpha, the golden image has none";
    return verdict;
  }
  if (golden.scene_hash != render.scene_hash) verdict.notes.push_back("the scene's files have changed");
  verdict.mean_change = mean_change(golden.mean, render.mean);
  judge_pixels(golden, render, thresholds, verdict);
  if (request) judge_display(golden, *request, verdict);
  return verdict;
}

double mean_flip(const GoldenImage& a, const GoldenImage& b) {
  const Flip flip = measure_flip({a.mean, b.mean, ValueKind::linear});
  return map_mean(flip.map, PixelSelection(a.mean.width, a.mean.height));
}

}  // namespace candil

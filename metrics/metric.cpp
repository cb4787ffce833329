#include "metrics/metric.h"

#include <algorithm>
#include <array>

namespace candil {
namespace {

constexpr std::array everything = {Metric::exact, Metric::max,    Metric::error, Metric::mse,
                                   Metric::rmse,  Metric::relmse, Metric::psnr,  Metric::bias,
                                   Metric::ssim,  Metric::flip,   Metric::ztest};

}  // namespace

std::span<const Metric> all_metrics() { return everything; }

std::string metric_name(Metric metric) {
  switch (metric) {
    case Metric::exact:
      return "exact";
    case Metric::max:
      return "max";
    case Metric::error:
      return "error";
    case Metric::mse:
      return "mse";
    case Metric::rmse:
      return "rmse";
    case Metric::relmse:
      return "relmse";
    case Metric::psnr:
      return "psnr";
    case Metric::bias:
      return "bias";
    case Metric::ssim:
      return "ssim";
    case Metric::flip:
      return "flip";
    case Metric::ztest:
      return "ztest";
  }
  return "";
}

std::optional<Metric> metric_from_name(std::string_view name) {
  const auto* const found = std::ranges::find(everything, name, metric_name);
  return found == everything.end() ? std::nullopt : std::optional(*found);
}

bool has_map(Metric metric) { return metric == Metric::error || metric == Metric::ssim || metric == Metric::flip; }

bool is_better_when_larger(Metric metric) {
  return metric == Metric::psnr || metric == Metric::ssim || metric == Metric::ztest;
}

}  // namespace candil

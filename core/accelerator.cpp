#include "core/accelerator.h"

#include <algorithm>
#include <array>

#include "core/bvh/brute.h"
#include "core/bvh/report.h"
#include "core/bvh/sah.h"
#include "core/bvh/two_level.h"
#include "core/bvh/wide_boxes.h"
#include "core/bvh/wide_triangles.h"
#include "core/embree_accelerator.h"

namespace candil {
namespace {

/// In the order of AcceleratorKind.
constexpr std::array names = {"embree", "report", "sah", "wide", "brute"};

template <typename Node>
std::unique_ptr<Accelerator> make_wide(const Scene& scene, HitFilter filter, const AcceleratorOptions& options) {
  return std::make_unique<TwoLevelAccelerator<WideTriangles<Node>, WideBoxes<Node>>>(scene, filter, options);
}

}  // namespace

std::vector<std::string> accelerator_names() { return {names.begin(), names.end()}; }

std::string accelerator_name(AcceleratorKind kind) { return names[static_cast<std::size_t>(kind)]; }

std::optional<AcceleratorKind> accelerator_from_name(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<AcceleratorKind>(found - names.begin());
}

std::unique_ptr<Accelerator> make_accelerator(const Scene& scene, HitFilter filter, const AcceleratorOptions& options) {
  switch (options.kind) {
    case AcceleratorKind::embree:
      break;
    case AcceleratorKind::report:
      return std::make_unique<TwoLevelAccelerator<ReportTriangles, ReportBoxes>>(scene, filter, options);
    case AcceleratorKind::sah:
      return std::make_unique<TwoLevelAccelerator<SahTriangles, SahBoxes>>(scene, filter, options);
    case AcceleratorKind::wide:
      if (options.is_compact) return make_wide<CompactNode>(scene, filter, options);
      return make_wide<WideNode>(scene, filter, options);
    case AcceleratorKind::brute:
      return std::make_unique<TwoLevelAccelerator<BruteTriangles, BruteBoxes>>(scene, filter, options);
  }
  return make_embree_accelerator(scene, filter, options);
}

}  // namespace candil

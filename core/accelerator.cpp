#include "core/accelerator.h"

#include "core/embree_accelerator.h"

namespace candil {

std::optional<AcceleratorKind> accelerator_from_name(std::string_view name) {
  if (name == "embree") return AcceleratorKind::embree;
  return std::nullopt;
}

std::unique_ptr<Accelerator> make_accelerator(const Scene& scene, HitFilter filter, const AcceleratorOptions& options) {
  switch (options.kind) {
    case AcceleratorKind::embree:
      break;
  }
  return make_embree_accelerator(scene, filter, options);
}

}  // namespace candil

/// The hierarchy of Intel's Embree behind our seam.
#pragma once

#include "core/accelerator.h"

namespace candil {

/// For make_accelerator().
std::unique_ptr<Accelerator> make_embree_accelerator(const Scene& scene, HitFilter filter,
                                                     const AcceleratorOptions& options);

}  // namespace candil

/// What instancing costs.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "core/accelerator.h"

namespace candil {

/// Bytes that one more instance of an object costs: the difference between `whole`, an accelerator of the scene, and
/// one that make() builds of a copy with a single instance of each object. Nothing if no object has several.
std::optional<double> bytes_per_instance(const Scene& scene, const Accelerator& whole,
                                         const std::function<std::unique_ptr<Accelerator>(const Scene&)>& make);

}  // namespace candil

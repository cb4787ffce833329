/// The limit of the limit: Embree asked directly, one ray at a time, with nothing around it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "bench/recording.h"

namespace candil {

/// The triangles and instances of a scene in Embree scenes of their own, built as the accelerator builds them (robust,
/// default quality), without filter functions: rays also end on the backs of single-sided surfaces.
class BareEmbree {
 public:
  /// Nothing for a scene with shapes or transparency by alpha.
  static std::optional<BareEmbree> make(const Scene& scene);

  /// Shoots the rays as they are by rtcIntersect1 or, shadow rays, by rtcOccluded1. Returns how many hit.
  std::uint64_t shoot(std::span<const Ray> rays, RayKind kind) const;

 private:
  struct Handles;
  std::shared_ptr<const Handles> handles_;
};

}  // namespace candil

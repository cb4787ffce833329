/// The seam behind which rays find triangles: Embree today, hand-rolled hierarchies beside it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/ray.h"
#include "core/scene.h"

namespace candil {

/// Decides whether a geometric hit counts: alpha coverage and invisible back faces. Called inside the traversal for the
/// meshes whose material asks for it (`hit_needs_filter`); true keeps the hit. Must be pure: the same ray and hit
/// always get the same answer.
struct HitFilter {
  bool (*needs_filter)(const Scene&, const Material&) = nullptr;
  /// `is_front_face`: the ray comes from the side that sees the triangle's vertices counter-clockwise in object space.
  bool (*accept)(const Scene&, const Ray& world_ray, const Hit&, bool is_front_face) = nullptr;
};

class Accelerator {
 public:
  virtual ~Accelerator() = default;
  /// The nearest accepted hit with t in [0, ray.t_max].
  virtual std::optional<Hit> intersect(const Ray& ray) const = 0;
  /// The same for many rays; `hits` is as long as `rays`, and a miss has t = infinity.
  virtual void intersect_each(std::span<const Ray> rays, std::span<Hit> hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = intersect(rays[i]).value_or(Hit{});
  }
  /// Whether there is any accepted hit with t in [0, ray.t_max].
  virtual bool occluded(const Ray& ray) const = 0;
  /// Bytes that the hierarchy occupies, the scene itself not counted.
  virtual std::size_t memory_bytes() const = 0;
};

enum class AcceleratorKind : std::uint8_t {
  embree,  ///< Intel's library.
  report,  ///< core/bvh/report.h: that of the report, slow on purpose.
  sah,     ///< core/bvh/sah.h: a binary hierarchy, as textbooks have it.
  wide,    ///< core/bvh/wide_node.h: our fastest, eight children per node.
  brute,   ///< core/bvh/brute.h: no hierarchy, the oracle.
};

/// The names of all kinds, in their order.
std::vector<std::string> accelerator_names();
std::string accelerator_name(AcceleratorKind kind);
/// Nothing for a name that is not among them.
std::optional<AcceleratorKind> accelerator_from_name(std::string_view name);

/// The words of AcceleratorOptions::isa for which `wide` has code in this build that this processor runs, the best one
/// last: "sse4.2", "avx2", "avx512" (levels 2, 3 and 4 of x86-64).
std::vector<std::string> wide_instruction_sets();

/// What a build may cost for what it saves later.
enum class BuildQuality : std::uint8_t { low, medium, high };

struct AcceleratorOptions {
  AcceleratorKind kind = AcceleratorKind::embree;
  BuildQuality quality = BuildQuality::medium;  ///< Of those that have a choice.
  bool is_robust = true;                        ///< Embree: no ray slips between two triangles of a closed mesh.
  bool is_compact = false;                      ///< Embree: less memory, slower rays. Wide: nodes of 8-bit planes.
  std::string isa;  ///< Embree, wide: the instruction set, as Embree's documentation names them; empty: the best.
  std::string frequency_level;  ///< Embree: the widest vectors, "simd128" to "simd512"; empty: its own choice.
};

/// Builds a hierarchy on all threads of the calling task arena. The scene must outlive the result.
/// Throws std::runtime_error when Embree cannot be started or memory runs out.
std::unique_ptr<Accelerator> make_accelerator(const Scene& scene, HitFilter filter,
                                              const AcceleratorOptions& options = {});

/// "3.13.5": the version of the library that is linked.
std::string embree_version();

}  // namespace candil

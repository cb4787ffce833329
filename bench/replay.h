/// Shooting recorded rays again, and how long that takes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "bench/recording.h"

namespace candil {

/// Rays are shot, and given to threads, in blocks of this size.
inline constexpr std::size_t replay_block_size = 1024;

/// Shoots rays and tells how many of them hit, which keeps the compiler from leaving them out.
using Shoot = std::function<std::uint64_t(std::span<const Ray>)>;

/// Rays of that kind through an accelerator, which must live as long as the result.
Shoot shoot_through(const Accelerator& accelerator, RayKind kind);

/// Every `stride`-th block of some rays: all of them, or a fair choice for who is too slow for all.
struct RayChoice {
  std::span<const Ray> rays;
  std::size_t stride = 1;

  std::size_t block_count() const;
  /// The i-th block that is chosen; the last one of all may be shorter.
  std::span<const Ray> block(std::size_t i) const;
  std::size_t ray_count() const;
};

struct Replay {
  double seconds = 0;
  std::uint64_t hits = 0;
};

/// Shoots the chosen rays on that many threads.
Replay replay(const RayChoice& choice, int threads, const Shoot& shoot);

/// All rays if they take about `longest_seconds` at the most, else so many that those take about as long; at least one
/// block. Shoots some of them to find out, which also warms up.
RayChoice choose_rays(std::span<const Ray> rays, double longest_seconds, int threads, const Shoot& shoot);

/// Runs on exactly that many threads, the calling one included, also where the machine has fewer.
void on_threads(int threads, const std::function<void()>& work);

/// Wall-clock time of a call.
double seconds_of(const std::function<void()>& work);

}  // namespace candil

#include "metrics/flip_tile.h"

namespace candil {

namespace baseline {
void raise_flip_of_target(const FlipTile& tile);
}
#ifdef CANDIL_FLIP_HAS_V4
namespace v4 {
void raise_flip_of_target(const FlipTile& tile);
}
#endif

void raise_flip(const FlipTile& tile) {
#ifdef CANDIL_FLIP_HAS_V4
  static const bool has_v4 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                             __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                             __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                             __builtin_cpu_supports("avx512vl");
  if (has_v4) return v4::raise_flip_of_target(tile);
#endif
  baseline::raise_flip_of_target(tile);
}

}  // namespace candil

/// The words of --accel.
#pragma once

#include <string_view>

#include "core/accelerator.h"

namespace candil {

inline constexpr const char* accelerator_help =
    "Hierarchy that finds the hits: embree (default), wide (eight children per node), sah (surface area "
    "heuristic), report (medians), brute (none); "
    "options: embree:quality=low|medium|high,robust=on|off,compact=on|off,isa=sse4.2|avx2|...,"
    "frequency=simd128|simd256|simd512, wide:quality=low|medium|high,compact=on|off,isa=avx2|avx512, "
    "sah:quality=low|medium|high";

/// "NAME[:KEY=VALUE,...]". Throws UsageError, which names `option`.
AcceleratorOptions parse_accelerator(std::string_view option, std::string_view text);

}  // namespace candil

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/wide_kernels.h"

// The level of x86-64 that the rest of the program is compiled for.
#if defined(__AVX512F__) && defined(__AVX512VL__)
#define CANDIL_BASELINE_ISA "avx512"
#elif defined(__AVX2__)
#define CANDIL_BASELINE_ISA "avx2"
#else
#define CANDIL_BASELINE_ISA "sse4.2"
#endif

namespace candil {

namespace baseline {
const WideKernels& wide_kernels_of_target();
}
#ifdef CANDIL_HAS_V3
namespace v3 {
const WideKernels& wide_kernels_of_target();
}
#endif
#ifdef CANDIL_HAS_V4
namespace v4 {
const WideKernels& wide_kernels_of_target();
}
#endif

namespace {

struct Target {
  std::string_view isa;
  const WideKernels& (*kernels)();
  bool is_supported;  // by this processor
};

#if defined(CANDIL_HAS_V3) || defined(CANDIL_HAS_V4)
bool has_v3() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
}
#endif
#ifdef CANDIL_HAS_V4
bool has_v4() {
  return has_v3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/// The best one last.
auto targets() {
  return std::to_array<Target>({
      {CANDIL_BASELINE_ISA, baseline::wide_kernels_of_target, true},
#ifdef CANDIL_HAS_V3
      {"avx2", v3::wide_kernels_of_target, has_v3()},
#endif
#ifdef CANDIL_HAS_V4
      {"avx512", v4::wide_kernels_of_target, has_v4()},
#endif
  });
}

}  // namespace

std::vector<std::string> wide_instruction_sets() {
  std::vector<std::string> names;
  for (const Target& target : targets())
    if (target.is_supported) names.emplace_back(target.isa);
  return names;
}

const WideKernels& wide_kernels(std::string_view isa) {
  const WideKernels* chosen = nullptr;
  for (const Target& target : targets())
    if (target.is_supported && (isa.empty() || isa == target.isa)) chosen = &target.kernels();
  if (chosen == nullptr) throw std::runtime_error("wide has no code for " + std::string(isa) + " here");
  return *chosen;
}

}  // namespace candil

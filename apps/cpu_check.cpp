// Says in one line why the program cannot run on a processor older than the one it was compiled for, instead of
// dying of an illegal instruction. This file alone is compiled for any x86-64 (apps/CMakeLists.txt); the check runs
// before the initialisers of every other file, and calls nothing that those could have compiled for the newer
// processor.

#if defined(CANDIL_X86_64_LEVEL)

#include <cpuid.h>
#include <unistd.h>

namespace {

constexpr int exit_wrong_usage = 2;

bool has_extended_feature(unsigned leaf, unsigned bit_of_ecx) {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(leaf, &eax, &ebx, &ecx, &edx) != 0 && (ecx & bit_of_ecx) != 0;
}

/// The first instruction set of the x86-64 psABI level that the processor (or the operating system, which must save
/// the wider registers) lacks; null if there is none.
const char* missing_instruction_set() {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("sse4.2")) return "SSE4.2";
  if (!__builtin_cpu_supports("popcnt")) return "POPCNT";
#if CANDIL_X86_64_LEVEL >= 3
  if (!__builtin_cpu_supports("avx2")) return "AVX2";
  if (!__builtin_cpu_supports("bmi")) return "BMI1";
  if (!__builtin_cpu_supports("bmi2")) return "BMI2";
  if (!__builtin_cpu_supports("fma")) return "FMA";
  // GCC 12 and Clang 14 do not both know these by name.
  if (!has_extended_feature(1, bit_F16C)) return "F16C";
  if (!has_extended_feature(1, bit_MOVBE)) return "MOVBE";
  if (!has_extended_feature(0x80000001, bit_LZCNT)) return "LZCNT";
#endif
#if CANDIL_X86_64_LEVEL >= 4
  if (!__builtin_cpu_supports("avx512f")) return "AVX512F";
  if (!__builtin_cpu_supports("avx512bw")) return "AVX512BW";
  if (!__builtin_cpu_supports("avx512cd")) return "AVX512CD";
  if (!__builtin_cpu_supports("avx512dq")) return "AVX512DQ";
  if (!__builtin_cpu_supports("avx512vl")) return "AVX512VL";
#endif
  return nullptr;
}

void print(const char* text) {
  const char* end = text;
  while (*end != '\0') ++end;
  // Nothing can be done about a failure; the exit code still tells.
  if (write(STDERR_FILENO, text, static_cast<unsigned long>(end - text)) < 0) _exit(exit_wrong_usage);
}

// 101 is the earliest priority that programs may use.
__attribute__((constructor(101))) void check_processor() {
  const char* missing = missing_instruction_set();
  if (missing == nullptr) return;
  print("candil: this processor lacks ");
  print(missing);
  print(", which this build needs; build it here with: ./dev build release -DCANDIL_MARCH=x86-64\n");
  _exit(exit_wrong_usage);
}

}  // namespace

#endif

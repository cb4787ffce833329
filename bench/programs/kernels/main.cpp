// The small parts of a render, each by itself: nanoseconds for one call. With the arguments of Google Benchmark, such
// as
// --benchmark_filter=closure.
#include <benchmark/benchmark.h>

#include "core/denormals.h"

int main(int argc, char** argv) {
  const candil::DenormalsAreZero denormals_are_zero;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

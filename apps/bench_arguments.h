/// The arguments of `candil bench`.
#pragma once

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments; parsing fills `options`, which must outlive it. Values out of range throw UsageError
/// while parsing.
void add_bench_arguments(CLI::App& app, BenchOptions& options);

/// What is not given gets its default. To be called after parsing.
void complete_bench_arguments(BenchOptions& options);

}  // namespace candil

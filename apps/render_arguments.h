/// The arguments of `candil render`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares all but the scene: what can be asked of any render. Parsing fills `options`, which must outlive it. Values
/// out of range throw UsageError while parsing.
void add_render_options(CLI::App& app, RenderOptions& options);

/// Declares the arguments; parsing fills `options`, which must outlive it. Values out of range throw UsageError
/// while parsing.
void add_render_arguments(CLI::App& app, RenderOptions& options);

/// The words of --integrator and --filter. They throw UsageError, which names `option`.
IntegratorKind parse_integrator(std::string_view option, std::string_view text);
FilterKind parse_filter(std::string_view option, std::string_view text);

inline constexpr std::uint64_t max_samples = std::uint64_t{1} << 24;

/// What only shows when all arguments are known. Throws UsageError.
void check_render_arguments(RenderOptions& options);

/// The options that these words of a command line mean, those after `candil render`. Throws UsageError.
RenderOptions parse_render_words(const std::vector<std::string>& words);

/// Notes in RenderOptions::given which options of `app` were there.
void note_given_options(const CLI::App& app, RenderOptions& options);

}  // namespace candil

/// Tone mapping operators as the command line names them: `reinhard02:key=0.3,white=4`.
#pragma once

#include <string>
#include <string_view>

#include "core/tonemap.h"

namespace candil {

/// NAME[:KEY=VALUE,...]. Throws UsageError, which names `option` and lists what is allowed.
Tonemap parse_tonemap(std::string_view option, std::string_view text);

/// One line for each operator, and under it one for each of its parameters.
std::string tonemap_help();

}  // namespace candil

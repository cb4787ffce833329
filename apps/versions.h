/// Version numbers of the program and of the libraries that its pictures depend on.
#pragma once

#include <string>

namespace candil {

/// "0.1.0".
std::string candil_version();
/// "candil 0.1.0, Embree 3.13.5, OpenImageIO 2.4.7".
std::string version_line();

}  // namespace candil

/// What `candil --list-extensions` prints.
#pragma once

#include <string>

namespace candil {

/// The glTF extensions that candil knows, with what it makes of each: a table for people, or JSON for machines.
std::string list_extensions(bool is_json);

}  // namespace candil

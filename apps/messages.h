/// Lines for people on standard error. Names out of files may hold anything: control characters are shown as '?', so
/// that a message stays one line and a terminal is not told what to do.
#pragma once

#include <string>

namespace candil {

void print_error(const std::string& message);    ///< "error: ..."
void print_warning(const std::string& message);  ///< "warning: ..."
void print_note(const std::string& message);     ///< The message alone.

/// `text` with control characters replaced by '?'.
std::string printable(std::string text);
/// `text` with line breaks replaced by spaces, none at its end.
std::string one_line(std::string text);

}  // namespace candil

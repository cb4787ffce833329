#include "apps/messages.h"

#include <algorithm>
#include <cstdio>

namespace candil {
namespace {

void print_line(const char* prefix, const std::string& message) {
  const std::string line = prefix + printable(message) + "\n";
  std::fputs(line.c_str(), stderr);
}

}  // namespace

std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

void print_error(const std::string& message) { print_line("error: ", message); }
void print_warning(const std::string& message) { print_line("warning: ", message); }
void print_note(const std::string& message) { print_line("", message); }

}  // namespace candil

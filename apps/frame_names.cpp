#include "apps/frame_names.h"

#include <fmt/format.h>

#include <filesystem>
#include <regex>

#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {

FrameRange parse_frames(const std::string& option, const std::string& text) {
  const std::vector<std::string_view> ends = split(text, '-');
  if (ends.size() > 2) throw UsageError(option + ": '" + text + "' is no range of frames such as 1-48");
  const auto frame = [&](std::string_view end) {
    return static_cast<std::uint32_t>(parse_integer(option, end, 0, largest_frame));
  };
  const FrameRange range{frame(ends.front()), frame(ends.back())};
  if (range.first > range.last) throw UsageError(option + ": the last frame comes before the first one");
  return range;
}

std::string frame_name(const std::string& option, const std::string& name, std::uint32_t frame) {
  // Either of Python and fmt, or of printf; at most nine digits.
  static const std::regex place(R"(\{(?::(0?)([1-9]?)d?)?\}|%(0?)([1-9]?)d)");
  std::smatch found;
  if (!std::regex_search(name, found, place)) {
    std::filesystem::path path(name);
    path.replace_filename(fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string()));
    return path.string();
  }
  const std::string rest = found.suffix().str();
  if (std::regex_search(rest, place)) throw UsageError(option + ": " + name + " has two places for the frame's number");
  const std::string zero = found[1].str() + found[3].str(), width = found[2].str() + found[4].str();
  const int digits = width.empty() ? 0 : std::stoi(width);
  const std::string number = zero.empty() ? fmt::format("{:{}}", frame, digits) : fmt::format("{:0{}}", frame, digits);
  return found.prefix().str() + number + rest;
}

}  // namespace candil

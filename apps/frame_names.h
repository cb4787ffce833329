/// Which frames a sequence has, and the names of their files.
#pragma once

#include <cstdint>
#include <string>

namespace candil {

/// Frames of an animation, both ends included. Frame k is at k / fps seconds.
struct FrameRange {
  std::uint32_t first = 0, last = 0;
};

inline constexpr std::uint32_t largest_frame = 9'999'999;

/// "A-B" or "A" (one frame). Throws UsageError that names the option.
FrameRange parse_frames(const std::string& option, const std::string& text);

/// The name for one frame: a place for its number, {} or {:04} or %d or %04d, is replaced by it; a name without any
/// gets _0001 before its extension. Throws UsageError, by `option`, for two places.
std::string frame_name(const std::string& option, const std::string& name, std::uint32_t frame);

}  // namespace candil

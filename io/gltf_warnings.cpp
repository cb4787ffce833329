#include <algorithm>
#include <sstream>

#include "io/gltf_internal.h"

namespace candil {

void Warnings::add(const std::string& message) {
  constexpr std::size_t most = 100;
  if (messages_.size() >= most) {
    ++dropped_;
  } else if (seen_.insert(message).second) {
    messages_.push_back(message);
  }
}

std::vector<std::string> Warnings::take() {
  if (dropped_ > 0) messages_.push_back(std::to_string(dropped_) + " more warnings");
  return std::move(messages_);
}

float in_range(double value, double low, double high, const std::string& place, Warnings& warnings) {
  if (value >= low && value <= high) return static_cast<float>(value);
  const double nearest = std::clamp(value, low, high);
  std::ostringstream message;
  message << value << " is out of range, " << nearest << " is used";
  warnings.add(place, message.str());
  return static_cast<float>(nearest);
}

std::string indexed(const char* array, std::size_t index) {
  return std::string(array) + "[" + std::to_string(index) + "]";
}

}  // namespace candil

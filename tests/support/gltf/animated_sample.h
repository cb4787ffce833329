/// glTF files with an animation, built by tests channel by channel.
#pragma once

#include <string>
#include <vector>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {

struct AnimatedSample : GltfSample {
  std::vector<std::string> channels, animation_samplers;

  /// Moves what a JSON pointer of KHR_animation_pointer names; `type` is that of the values' accessor.
  void move(const std::string& pointer, const std::string& type, const std::vector<float>& times,
            const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    add_channel(R"({"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":")" + pointer + "\"}}}", type,
                times, values, interpolation);
  }
  void move_node(int node, const std::string& path, const std::string& type, const std::vector<float>& times,
                 const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
    add_channel("{\"node\":" + std::to_string(node) + ",\"path\":\"" + path + "\"}", type, times, values,
                interpolation);
  }

  /// The file; `name` is the animation's.
  std::string animated_json(const std::string& name = "move") const {
    GltfSample sample = *this;
    sample.root += ",\"animations\":[" + animation(name) + "]";
    return sample.json();
  }

  std::string animation(const std::string& name) const {
    return "{\"name\":\"" + name + "\",\"channels\":[" + joined(channels) + "],\"samplers\":[" +
           joined(animation_samplers) + "]}";
  }

 private:
  static std::string joined(const std::vector<std::string>& elements) {
    std::string text;
    for (const std::string& element : elements) text += (text.empty() ? "" : ",") + element;
    return text;
  }

  void add_channel(const std::string& target, const std::string& type, const std::vector<float>& times,
                   const std::vector<float>& values, const std::string& interpolation) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    const int input = add_accessor<float>(gl_float, "SCALAR", times.size(), times);
    const int output = add_accessor<float>(gl_float, type, values.size() / components, values);
    channels.push_back("{\"sampler\":" + std::to_string(animation_samplers.size()) + ",\"target\":" + target + "}");
    animation_samplers.push_back("{\"input\":" + std::to_string(input) + ",\"output\":" + std::to_string(output) +
                                 ",\"interpolation\":\"" + interpolation + "\"}");
  }
};

/// A triangle under node 0, to be moved.
inline AnimatedSample movable_triangle() {
  AnimatedSample sample;
  sample.add_triangle();
  return sample;
}

inline LoadOptions options_at(double seconds, const std::string& animation = "") {
  LoadOptions options;
  options.animation = animation;
  options.at = seconds;
  return options;
}

}  // namespace candil::test

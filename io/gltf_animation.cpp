#include "io/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_internal.h"

namespace candil {

namespace {

/// The JSON pointer of a channel; nothing for a channel without a target, which the specification wants ignored.
std::optional<std::string> pointer_of(const GltfAnimationChannel& channel) {
  if (channel.path == "pointer") return channel.pointer;
  if (channel.node < 0) return {};
  return "/nodes/" + std::to_string(channel.node) + "/" + channel.path;
}

std::optional<Interpolation> to_interpolation(const std::string& word) {
  if (word == "STEP") return Interpolation::step;
  if (word == "LINEAR") return Interpolation::linear;
  if (word == "CUBICSPLINE") return Interpolation::cubic_spline;
  return {};
}

std::vector<std::size_t> choose_animations(const GltfDocument& document, const std::string& chosen) {
  const std::vector<GltfAnimation>& animations = document.animations();
  std::vector<std::string> names;
  for (const GltfAnimation& animation : animations) names.push_back(animation.name);
  const bool is_named = std::find(names.begin(), names.end(), chosen) != names.end();
  if (chosen != "all" || is_named || animations.empty()) {
    return {find_choice(document, "animation", names, chosen.empty() ? "0" : chosen)};
  }
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < animations.size(); ++i) all.push_back(i);
  return all;
}

std::string accessor_text(int accessor) { return "accessor " + std::to_string(accessor) + " "; }

}  // namespace

std::vector<AnimationSummary> list_animations(const GltfDocument& document) {
  std::vector<AnimationSummary> list;
  std::map<int, double> ends;  // by accessor
  for (std::size_t a = 0; a < document.animations().size(); ++a) {
    const GltfAnimation& animation = document.animations()[a];
    AnimationSummary summary{animation.name, 0};
    for (const GltfAnimationSampler& sampler : animation.samplers) {
      const auto [end, is_new] = ends.try_emplace(sampler.input);
      const std::size_t count = accessor_count(document, sampler.input);
      const AccessorKind kind = accessor_kind(document, sampler.input);
      // Other inputs are refused when the animation is chosen.
      if (is_new && count > 0 && kind.type == "SCALAR" && kind.has_floats) {
        end->second = read_floats(document, sampler.input, count - 1, 1, indexed("animations", a)).front();
      }
      if (std::isfinite(end->second)) summary.seconds = std::max(summary.seconds, end->second);
    }
    list.push_back(std::move(summary));
  }
  return list;
}

GltfAnimator::GltfAnimator(const GltfDocument& document, const std::string& chosen, Warnings& warnings)
    : state_(std::make_unique<nlohmann::json>(document.movable_json())) {
  // Accessors may overlap: a few bytes must not become gigabytes of keys.
  constexpr std::size_t least = std::size_t{256} << 20, factor = 8;
  bytes_left_ = std::max(least, factor * document.total_bytes());
  for (const std::size_t index : choose_animations(document, chosen)) add_animation(document, index, warnings);
}

GltfAnimator::~GltfAnimator() = default;

void GltfAnimator::add_animation(const GltfDocument& document, std::size_t index, Warnings& warnings) {
  const GltfAnimation& animation = document.animations()[index];
  const std::string place = indexed("animations", index);
  std::set<std::string> targets;
  for (std::size_t c = 0; c < animation.channels.size(); ++c) {
    const GltfAnimationChannel& channel = animation.channels[c];
    const std::string channel_place = place + "." + indexed("channels", c);
    const std::optional<std::string> pointer = pointer_of(channel);
    if (!pointer) continue;
    if (!targets.insert(*pointer).second) {
      warnings.add(channel_place, "moves " + printable(*pointer) + " a second time; the last channel counts");
    }
    add_channel(document, animation, channel, place, channel_place, warnings);
  }
}

void GltfAnimator::add_channel(const GltfDocument& document, const GltfAnimation& animation,
                               const GltfAnimationChannel& source, const std::string& animation_place,
                               const std::string& place, Warnings& warnings) {
  const std::string pointer = *pointer_of(source);
  const std::optional<GltfProperty> property = find_property(*state_, pointer);
  if (!property) {
    warnings.add(place, printable(pointer) + " is nothing that can be moved, the channel is ignored");
    return;
  }
  const GltfAnimationSampler& sampler = animation.samplers[source.sampler];
  const std::string sampler_place = animation_place + "." + indexed("samplers", source.sampler);
  const std::optional<Interpolation> interpolation = to_interpolation(sampler.interpolation);
  if (!interpolation) {
    document.fail(sampler_place + ".interpolation",
                  quoted_text(sampler.interpolation) + " is none of: STEP LINEAR CUBICSPLINE");
  }
  Channel channel{*property, {*interpolation, property->is_rotation, property->components, {}, {}}, place};
  AnimationCurve& curve = channel.curve;
  if (property->kind == GltfProperty::Kind::boolean) curve.interpolation = Interpolation::step;
  curve.times = times(document, sampler.input, sampler_place + ".input", warnings);
  const std::string output_place = sampler_place + ".output";
  const std::size_t width = property->is_weights ? 1 : property->components;
  const AccessorKind kind = accessor_kind(document, sampler.output);
  const std::string wanted = width == 1 ? "SCALAR" : "VEC" + std::to_string(width);
  if (kind.type != wanted) {
    document.fail(output_place,
                  accessor_text(sampler.output) + "must be of type " + wanted + " for " + printable(pointer));
  }
  curve.values = values(document, sampler.output, output_place);
  // Neither factor exceeds 2^48 / 4 bytes of keys that were read, or the number of targets in the file.
  const std::size_t parts = *interpolation == Interpolation::cubic_spline ? 3 : 1;
  const std::size_t needed = curve.times.size() * parts;
  if (curve.values.size() / property->components < needed) {
    document.fail(output_place, accessor_text(sampler.output) + "has " + std::to_string(curve.values.size() / width) +
                                    " elements, " + std::to_string(curve.times.size()) + " keys need " +
                                    std::to_string(needed * (property->components / width)));
  }
  prepare_property(*state_, *property);
  length_ = std::max(length_, double(curve.times.back()));
  channels_.push_back(std::move(channel));
}

std::span<const float> GltfAnimator::values(const GltfDocument& document, int accessor, const std::string& place) {
  const auto [entry, is_new] = accessors_.try_emplace(accessor);
  if (!is_new) return entry->second;
  const std::size_t count = accessor_count(document, accessor);
  const std::size_t components = accessor_kind(document, accessor).components;
  if (count > bytes_left_ / (components * sizeof(float))) {
    document.fail(place, "the keys expand to far more than the file has bytes for");
  }
  bytes_left_ -= count * components * sizeof(float);
  entry->second = read_floats(document, accessor, 0, count, place);
  for (std::size_t i = 0; i < entry->second.size(); ++i) {
    if (!std::isfinite(entry->second[i])) {
      document.fail(place, accessor_text(accessor) + "element " + std::to_string(i / components) + " is not finite");
    }
  }
  return entry->second;
}

std::span<const float> GltfAnimator::times(const GltfDocument& document, int accessor, const std::string& place,
                                           Warnings& warnings) {
  const AccessorKind kind = accessor_kind(document, accessor);
  if (kind.type != "SCALAR" || !kind.has_floats) {
    document.fail(place, accessor_text(accessor) + "must be SCALAR of floats: seconds");
  }
  const std::span<const float> keys = values(document, accessor, place);
  if (keys.empty()) document.fail(place, accessor_text(accessor) + "has no keys");
  for (std::size_t k = 1; k < keys.size(); ++k) {
    if (keys[k] > keys[k - 1]) continue;
    if (keys[k] < keys[k - 1]) {
      document.fail(place,
                    accessor_text(accessor) + "element " + std::to_string(k) + " is earlier than the one before");
    }
    warnings.add(place, "has two keys at the same time");
  }
  return keys;
}

void GltfAnimator::move(GltfDocument& document, double seconds) {
  std::set<std::string> parts;
  for (const Channel& channel : channels_) {
    const std::vector<double> values = evaluate(channel.curve, seconds);
    for (const double value : values) {
      if (!(std::abs(value) <= std::numeric_limits<float>::max())) {
        document.fail(channel.place, "its spline overflows at " + std::to_string(seconds) + " s");
      }
    }
    set_property(*state_, channel.property, values);
    parts.insert(channel.property.part);
  }
  nlohmann::json moved = nlohmann::json::object();
  for (const std::string& part : parts) moved[part] = (*state_)[part];
  document.pose(moved);
}

}  // namespace candil

/// The animations of a glTF file: what moves, along which curves, and the file's state at any time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/animation_curve.h"
#include "io/gltf_document.h"
#include "io/gltf_pointer.h"
#include "io/load_scene.h"

namespace candil {

class Warnings;

/// Name and length of every animation in the file.
std::vector<AnimationSummary> list_animations(const GltfDocument& document);

/// Moves a document through time.
class GltfAnimator {
 public:
  /// Chooses one animation by its index or name, "all", or (empty) the first one. Throws InputError for a choice that
  /// is not there, and for keys that make no curve; what cannot be moved is left out with a warning.
  GltfAnimator(const GltfDocument& document, const std::string& chosen, Warnings& warnings);
  ~GltfAnimator();

  /// Seconds from 0 to the last key.
  double length() const { return length_; }

  /// Puts the document into its state at that time; what does not move stays as it is in the file.
  void move(GltfDocument& document, double seconds);

 private:
  struct Channel {
    GltfProperty property;
    AnimationCurve curve;
    std::string place;
  };
  void add_animation(const GltfDocument& document, std::size_t index, Warnings& warnings);
  void add_channel(const GltfDocument& document, const GltfAnimation& animation, const GltfAnimationChannel& channel,
                   const std::string& animation_place, const std::string& place, Warnings& warnings);
  std::span<const float> times(const GltfDocument& document, int accessor, const std::string& place,
                               Warnings& warnings);
  std::span<const float> values(const GltfDocument& document, int accessor, const std::string& place);

  std::unique_ptr<nlohmann::json> state_;        // the parts of the file that move
  std::map<int, std::vector<float>> accessors_;  // that were read
  std::size_t bytes_left_;                       // that the keys may take
  std::vector<Channel> channels_;
  double length_ = 0;
};

}  // namespace candil

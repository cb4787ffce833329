/// A glTF file that is kept open while its animation plays.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "io/load_scene.h"

namespace candil {

class SceneSequence {
 public:
  /// Throws InputError as load_scene() does, and for files without animations. `options.at` does not matter.
  SceneSequence(const std::filesystem::path& path, const LoadOptions& options);
  ~SceneSequence();

  /// What load_scene() gives for that time, to the bit. What does not move is read from the file once, images are
  /// decoded once.
  LoadedScene at(double seconds);
  /// Takes back the scene of an earlier time, for its images. Without this they are decoded again.
  void recycle(Scene scene);

  /// What the animation does as a whole, from a few of its times: a camera that frames all of it stands still, and so
  /// does a studio that is lit if the file never brings light.
  struct Motion {
    std::vector<Vec3> outline;  ///< As scene_outline(), of all times together; coarser for large scenes.
    bool has_light = false;
  };
  const Motion& motion();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace candil

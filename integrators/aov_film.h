/// Where the AOVs of a render are summed, beside its Film and in the same blocks.
#pragma once

#include "core/block_sums.h"
#include "core/camera.h"
#include "integrators/first_hit.h"

namespace candil {

/// One pixel has one writer at a time, as in Film. The context outlives it.
class AovFilm {
 public:
  /// The AOVs of the settings. At least one.
  AovFilm(const RenderContext& context, const Camera& camera, const RenderSettings& settings);

  void begin_block();
  /// The samples of a pixel in a block, in their order; at most one block's. Ids are found in the first block.
  void add_pixel(int x, int y, std::span<const CameraSample> samples, bool is_first_block, RayCounts& rays);
  /// See Film.
  void end_block(std::uint32_t samples);
  void drop_block();

  /// One for each AOV, in the order of the settings.
  std::vector<ImageLayer> layers() const;

 private:
  /// A mean under way: the sum of the values, and the number of hits as w.
  struct Mean {
    Aov aov;
    BlockSums<Vec4> sums;
  };

  void add_means(std::size_t pixel, std::span<const CameraSample> samples, RayCounts& rays);
  void find_ids(int x, int y, RayCounts& rays);
  Vec3 value(Aov aov, const Hit& hit, const FirstHit& first_hit) const;
  Image image_of(Aov aov) const;

  const RenderContext& context_;
  int width_, height_;
  std::vector<Aov> aovs_;
  CameraRays camera_, pinhole_;
  std::vector<Mean> means_;
  std::vector<float> material_ids_, object_ids_;  // both, or neither when no ids are wanted
};

}  // namespace candil

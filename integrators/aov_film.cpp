#include "integrators/aov_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/shape.h"

namespace candil {
namespace {

constexpr std::size_t rays_at_once = 16;
constexpr std::size_t most_means = 5;

/// Within +-1e30, so that no sum of 2^24 of them overflows.
Vec3 bounded(Vec3 v) {
  constexpr float limit = 1e30f;
  for (int i = 0; i < 3; ++i) v[i] = std::isnan(v[i]) ? 0 : std::clamp(v[i], -limit, limit);
  return v;
}

Camera without_lens(Camera camera) {
  camera.lens_radius = 0;
  return camera;
}

}  // namespace

AovFilm::AovFilm(const RenderContext& context, const Camera& camera, const RenderSettings& settings)
    : context_(context),
      width_(settings.width),
      height_(settings.height),
      aovs_(settings.aovs),
      camera_(camera, width_, height_),
      pinhole_(without_lens(camera), width_, height_) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  for (const Aov aov : aovs_) {
    const bool is_known = std::ranges::find(means_, aov, &Mean::aov) != means_.end();
    if (!is_id(aov) && !is_known) means_.push_back({aov, BlockSums<Vec4>(pixels)});
  }
  if (std::ranges::any_of(aovs_, is_id)) {
    constexpr float nothing = -1;
    material_ids_.assign(pixels, nothing);
    object_ids_.assign(pixels, nothing);
  }
}

void AovFilm::begin_block() {
  for (Mean& mean : means_) mean.sums.begin_block();
}

void AovFilm::end_block(std::uint32_t samples) {
  for (Mean& mean : means_) mean.sums.end_block(samples);
}

void AovFilm::drop_block() {
  for (Mean& mean : means_) mean.sums.drop_block();
}

void AovFilm::add_pixel(int x, int y, std::span<const CameraSample> samples, bool is_first_block, RayCounts& rays) {
  if (is_first_block && !material_ids_.empty()) find_ids(x, y, rays);
  if (!means_.empty()) add_means(static_cast<std::size_t>(y) * width_ + x, samples, rays);
}

void AovFilm::find_ids(int x, int y, RayCounts& rays) {
  ++rays.aov;
  const std::optional<Hit> hit = context_.accelerator.intersect(pinhole_.ray(Vec2(x, y) + 0.5f, Vec2(0)));
  if (!hit) return;
  const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
  const std::size_t object = hit->is_shape() ? context_.scene.instances.size() + hit->triangle : hit->instance;
  material_ids_[pixel] = static_cast<float>(material_of(context_.scene, *hit));
  object_ids_[pixel] = static_cast<float>(object);
}

void AovFilm::add_means(std::size_t pixel, std::span<const CameraSample> samples, RayCounts& rays) {
  std::array<PairwiseSum<Vec4>, most_means> sums;
  std::array<Ray, rays_at_once> camera_rays;
  std::array<Hit, rays_at_once> hits;
  rays.aov += samples.size();
  for (std::size_t first = 0; first < samples.size(); first += rays_at_once) {
    const std::size_t count = std::min(rays_at_once, samples.size() - first);
    for (std::size_t i = 0; i < count; ++i) camera_rays[i] = samples[first + i].ray;
    context_.accelerator.intersect_each(std::span(camera_rays).first(count), std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      if (hits[i].is_miss()) {
        for (std::size_t k = 0; k < means_.size(); ++k) sums[k].add(Vec4(0));
        continue;
      }
      const FirstHit first_hit = make_first_hit(context_, camera_rays[i], hits[i]);
      for (std::size_t k = 0; k < means_.size(); ++k) {
        sums[k].add(Vec4(bounded(value(means_[k].aov, hits[i], first_hit)), 1));
      }
    }
  }
  for (std::size_t k = 0; k < means_.size(); ++k) means_[k].sums.block_pixel(pixel) = sums[k].total();
}

Vec3 AovFilm::value(Aov aov, const Hit& hit, const FirstHit& first_hit) const {
  switch (aov) {
    case Aov::normals:
      return first_hit.bsdf.shading_normal();
    case Aov::depth:
      return Vec3(camera_.depth(first_hit.position), 0, 0);
    case Aov::albedo:
      return first_hit.albedo;
    case Aov::position:
      return first_hit.position;
    case Aov::uv:
      return Vec3(first_texture_coordinates(context_.scene, hit), 0);
    case Aov::material:
    case Aov::object:
      break;  // no means
  }
  return Vec3(0);
}

std::vector<ImageLayer> AovFilm::layers() const {
  std::vector<ImageLayer> layers;
  for (const Aov aov : aovs_) layers.push_back({aov_name(aov), aov_channels(aov), image_of(aov)});
  return layers;
}

Image AovFilm::image_of(Aov aov) const {
  const auto channels = static_cast<int>(aov_channels(aov).size());
  Image image(width_, height_, channels);
  if (is_id(aov)) {
    image.pixels = aov == Aov::material ? material_ids_ : object_ids_;
    return image;
  }
  const BlockSums<Vec4>& sums = std::ranges::find(means_, aov, &Mean::aov)->sums;
  for (std::size_t i = 0; i < image.pixels.size() / channels; ++i) {
    const Vec4 sum = sums.total(i);
    for (int c = 0; c < channels; ++c) image.pixels[i * channels + c] = sum.w > 0 ? sum[c] / sum.w : 0;
  }
  return image;
}

}  // namespace candil

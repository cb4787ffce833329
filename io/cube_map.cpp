#include "io/cube_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace candil {
namespace {

struct FacePoint {
  std::size_t face;
  Vec2 uv;  ///< (0, 0) is the upper left corner of the face's image.
};

/// OpenGL 4.6 specification, table 8.19, with s turned round: OpenGL's faces are those of a left-handed world.
FacePoint project(Vec3 d) {
  const Vec3 size = glm::abs(d);
  std::size_t face;
  float major, s, t;
  if (size.x >= size.y && size.x >= size.z) {
    face = d.x > 0 ? 0 : 1, major = size.x, s = d.x > 0 ? -d.z : d.z, t = -d.y;
  } else if (size.y >= size.z) {
    face = d.y > 0 ? 2 : 3, major = size.y, s = d.x, t = d.y > 0 ? d.z : -d.z;
  } else {
    face = d.z > 0 ? 4 : 5, major = size.z, s = d.z > 0 ? d.x : -d.x, t = -d.y;
  }
  return {face, {0.5f * (1 - s / major), 0.5f * (1 + t / major)}};
}

/// Bilinear, and constant beyond the middle of the outermost texels.
Vec3 lookup(const Image& image, Vec2 uv) {
  const int last = image.width - 1;
  const float x = glm::clamp(uv.x * static_cast<float>(image.width) - 0.5f, 0.0f, static_cast<float>(last));
  const float y = glm::clamp(uv.y * static_cast<float>(image.width) - 0.5f, 0.0f, static_cast<float>(last));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, last), bottom = std::min(top + 1, last);
  const auto texel = [&](int column, int row) {
    const float* p = image.pixel(column, row);
    return Vec3(p[0], p[1], p[2]);
  };
  const float fx = x - static_cast<float>(left), fy = y - static_cast<float>(top);
  return glm::mix(glm::mix(texel(left, top), texel(right, top), fx),
                  glm::mix(texel(left, bottom), texel(right, bottom), fx), fy);
}

/// As the image of an Environment has it: the centre towards -Z, the right half towards +X.
Vec3 direction_at(float u, float v) {
  const float phi = 2 * pi * (u - 0.5f), theta = pi * v;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

}  // namespace

Image to_latitude_longitude(const CubeFaces& faces, const Mat3& rotation) {
  constexpr int widest = 8192;
  // In the middle of a face a texel spans 2 / width radians, a little more than the 2 pi / (4 width) of a column.
  const int wanted = 4 * faces[0].width, width = std::clamp(wanted, 16, widest), height = width / 2;
  const int samples = std::max(2, 2 * wanted / width);  // across a texel, in each direction
  const Mat3 back = glm::transpose(rotation);
  Image image(width, height, 3);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      Vec3 sum(0);
      for (int i = 0; i < samples * samples; ++i) {
        const float column =
            static_cast<float>(x) + (static_cast<float>(i % samples) + 0.5f) / static_cast<float>(samples);
        const float row =
            static_cast<float>(y) + (static_cast<float>(i / samples) + 0.5f) / static_cast<float>(samples);
        const Vec3 towards = direction_at(column / static_cast<float>(width), row / static_cast<float>(height));
        const FacePoint point = project(back * towards);
        sum += lookup(faces[point.face], point.uv);
      }
      const Vec3 mean = sum / static_cast<float>(samples * samples);
      float* const pixel = image.pixel(x, y);
      pixel[0] = mean.x, pixel[1] = mean.y, pixel[2] = mean.z;
    }
  });
  return image;
}

}  // namespace candil

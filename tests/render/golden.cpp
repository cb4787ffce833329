#include "tests/render/golden.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "io/image_file.h"

namespace candil::test {
namespace {

constexpr int channels = 3;
constexpr int parts = 4;
constexpr int block_size = 8;
/// Values that do not vary at all may still differ in their last bits, and are stored rounded.
constexpr float smallest_spread = 0x1p-11f;
/// Significant bits of stored means and examples, and of spreads and limits.
constexpr int value_bits = 11, limit_bits = 8;
/// Half of the last of value_bits, as a part of the value: at most 2^-11.
constexpr double half_step = 0x1p-11;

float compressed(float radiance) {
  const float value = radiance / (1 + radiance);
  if (!std::isfinite(value)) throw std::runtime_error("a pixel is not finite");
  return value;
}

Image compressed(const Image& radiance) {
  Image result(radiance.width, radiance.height, channels);
  for (int y = 0; y < radiance.height; ++y) {
    for (int x = 0; x < radiance.width; ++x)
      std::transform(radiance.pixel(x, y), radiance.pixel(x, y) + channels, result.pixel(x, y),
                     [](float value) { return compressed(value); });
  }
  return result;
}

float median(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

/// Median plus six times the standard deviation that the median distance from it stands for.
float cut_limit(const std::vector<float>& values) {
  const float middle = median(values);
  std::vector<float> distances(values.size());
  std::transform(values.begin(), values.end(), distances.begin(), [&](float v) { return std::abs(v - middle); });
  return middle + 6 * std::max(1.4826f * median(std::move(distances)), smallest_spread);
}

/// To the nearest float of `bits` significant bits.
float rounded(float value, int bits) {
  const std::uint32_t dropped = 24 - bits;
  const std::uint32_t half = 1u << (dropped - 1);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) + half) & ~((1u << dropped) - 1));
}

Image rounded(Image image, int bits) {
  for (float& value : image.pixels) value = rounded(value, bits);
  return image;
}

/// Sums over a set of pixels of one channel.
struct Score {
  double difference = 0, rounding = 0, variance = 0, variance_squared = 0;

  void add(double mean, double pixel_difference, double pixel_variance) {
    difference += pixel_difference;
    rounding += half_step * mean;
    variance += pixel_variance;
    variance_squared += pixel_variance * pixel_variance;
  }
  /// The sum's Student t with the degrees of freedom of Welch and Satterthwaite, as a normal deviate (D. L. Wallace,
  /// Bounds on normal approximations to Student's and the chi-square distributions, 1959). What the rounding of stored
  /// means can account for does not count: where all pixels have one value, all are rounded alike.
  double normal_deviate() const {
    const double freedom = (golden_replicates - 1) * variance * variance / variance_squared;
    const double beyond = std::max(0.0, std::abs(difference) - rounding);
    const double t_squared = beyond * beyond / variance;
    return (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t_squared / freedom));
  }
};

/// Of channel c of two images of compressed values, `now` not rounded yet.
double paired_score(const Image& stored, const Image& now, int c) {
  // Less than two steps of rounding is no difference.
  constexpr auto two_steps = static_cast<float>(4 * half_step);
  double sum = 0, squares = 0;
  for (std::size_t i = c; i < stored.pixels.size(); i += channels) {
    const float a = stored.pixels[i], b = rounded(now.pixels[i], value_bits);
    const double beyond = std::max(0.0f, std::abs(b - a) - two_steps * std::max(a, b));
    sum += std::copysign(beyond, b - a);
    squares += beyond * beyond;
  }
  return squares > 0 ? std::abs(sum) / std::sqrt(squares) : 0;
}

}  // namespace

Golden make_golden(const std::function<Image(std::uint64_t seed)>& replicate) {
  std::vector<Image> replicates, others;
  for (int seed = 1; seed <= golden_replicates; ++seed) {
    replicates.push_back(compressed(replicate(seed)));
    others.push_back(compressed(replicate(golden_replicates + seed)));
  }
  const Image& first = replicates.front();
  const Image black(first.width, first.height, channels);
  Golden golden{black, black, black, rounded(compressed(replicate(0)), value_bits)};
  std::vector<float> values(golden_replicates);
  for (std::size_t i = 0; i < first.pixels.size(); ++i) {
    const auto value = [&](const Image& image) { return image.pixels[i]; };
    std::transform(others.begin(), others.end(), values.begin(), value);
    const float limit = rounded(cut_limit(values), limit_bits);
    std::transform(replicates.begin(), replicates.end(), values.begin(), value);
    double sum = 0, squares = 0;
    for (float& v : values) sum += v = std::min(v, limit);
    const double mean = sum / golden_replicates;
    for (const float v : values) squares += (v - mean) * (v - mean);
    golden.mean.pixels[i] = rounded(static_cast<float>(mean), value_bits);
    golden.spread.pixels[i] = rounded(static_cast<float>(std::sqrt(squares / (golden_replicates - 1))), limit_bits);
    golden.limit.pixels[i] = limit;
  }
  return golden;
}

void write_golden(const std::filesystem::path& path, const Golden& golden) {
  Image stacked(golden.mean.width, parts * golden.mean.height, channels);
  auto end = stacked.pixels.begin();
  for (const Image* part : {&golden.mean, &golden.spread, &golden.limit, &golden.example})
    end = std::copy(part->pixels.begin(), part->pixels.end(), end);
  write_image(path, stacked, false,
              {{"candil:golden", "mean, spread, limit and example of radiance / (1 + radiance)"}});
}

Golden read_golden(const std::filesystem::path& path) {
  const Image stacked = read_image(path);
  if (stacked.channels != channels || stacked.height % parts != 0)
    throw std::runtime_error(path.string() + ": is not a golden image");
  if (!std::all_of(stacked.pixels.begin(), stacked.pixels.end(), [](float value) { return std::isfinite(value); }))
    throw std::runtime_error(path.string() + ": a value is not finite");
  const auto part = [&](int index) {
    Image image(stacked.width, stacked.height / parts, channels);
    std::copy_n(stacked.pixels.begin() + index * static_cast<std::ptrdiff_t>(image.pixels.size()), image.pixels.size(),
                image.pixels.begin());
    return image;
  };
  return {part(0), part(1), part(2), part(3)};
}

Deviation deviation(const Golden& golden, const Image& render) {
  if (render.width != golden.mean.width || render.height != golden.mean.height)
    throw std::runtime_error("the golden image has another size");
  const Image values = compressed(render);
  const int width = values.width, height = values.height;
  Deviation result;
  std::array<Score, channels> image{};
  std::vector<char> is_outlier(static_cast<std::size_t>(width) * height);
  for (int top = 0; top < height; top += block_size) {
    for (int left = 0; left < width; left += block_size) {
      std::array<Score, channels> block{};
      for (int y = top; y < std::min(top + block_size, height); ++y) {
        for (int x = left; x < std::min(left + block_size, width); ++x) {
          for (int c = 0; c < channels; ++c) {
            const double value = std::min(values.pixel(x, y)[c], golden.limit.pixel(x, y)[c]);
            const double mean = golden.mean.pixel(x, y)[c], difference = value - mean;
            const double spread = golden.spread.pixel(x, y)[c];
            // Of the render's value, and of the mean of the replicates.
            const double variance =
                (spread * spread + smallest_spread * smallest_spread) * (1 + 1.0 / golden_replicates);
            block[c].add(mean, difference, variance), image[c].add(mean, difference, variance);
            if (difference * difference > 25 * variance) is_outlier[static_cast<std::size_t>(y) * width + x] = 1;
          }
        }
      }
      for (int c = 0; c < channels; ++c) {
        if (const double score = block[c].normal_deviate(); score > result.block)
          result.block = score,
          result.where = "pixels from (" + std::to_string(left) + ", " + std::to_string(top) + "), channel " + "RGB"[c];
      }
    }
  }
  for (int c = 0; c < channels; ++c) {
    result.image = std::max(result.image, image[c].normal_deviate());
    result.paired = std::max(result.paired, paired_score(golden.example, values, c));
  }
  result.outlier_share = static_cast<double>(std::count(is_outlier.begin(), is_outlier.end(), 1)) / is_outlier.size();
  return result;
}

bool is_within_limits(const Deviation& deviation) {
  return deviation.image <= image_limit && deviation.block <= block_limit && deviation.outlier_share <= outlier_limit &&
         deviation.paired <= paired_limit;
}

void PrintTo(const Deviation& deviation, std::ostream* stream) {
  *stream << "image " << deviation.image << ", block " << deviation.block << ", outliers " << deviation.outlier_share
          << ", paired " << deviation.paired;
}

}  // namespace candil::test

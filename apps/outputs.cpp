#include "apps/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "apps/usage_error.h"
#include "io/atomic_file.h"
#include "io/error.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

void write_standard_output(const std::vector<std::byte>& bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
    throw OutputError("standard output", "cannot be written");
}

Image without_alpha(const Image& image) {
  Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < rgb.pixels.size() / 3; ++i)
    std::copy_n(&image.pixels[i * image.channels], 3, &rgb.pixels[i * 3]);
  return rgb;
}

std::vector<ImageLayer> with_picture(const Image& picture, std::span<const ImageLayer> layers) {
  std::vector<ImageLayer> all = {{"", {"R", "G", "B"}, picture}};
  if (picture.channels == 4) all.front().channels.emplace_back("A");
  all.insert(all.end(), layers.begin(), layers.end());
  return all;
}

void write_output(const Output& output, const Image& linear, const DisplayOptions& display,
                  const ImageMetadata& metadata, std::span<const ImageLayer> layers) {
  const bool with_alpha = display.is_transparent && (output.is_standard_output() || has_alpha_channel(output.path));
  const Image image = with_alpha ? linear : without_alpha(linear);
  if (!layers.empty() && has_layers(output.path))
    return write_layers(output.path, with_picture(image, layers), metadata);
  if (!output.is_standard_output() && is_linear_format(output.path, display.ppm))
    return write_image(output.path, image, with_alpha, metadata, display.ppm);
  const Tonemap tonemap = display.tonemap.value_or(make_tonemap(TonemapKind::neutral));
  const Image shown = to_display(image, display.exposure, tonemap);
  if (output.is_standard_output()) return write_standard_output(encode_png(shown, with_alpha));
  write_image(output.path, shown, with_alpha, metadata, display.ppm);
}

void check_output(const Output& output) {
  if (output.is_standard_output()) {
    if (isatty(STDOUT_FILENO)) throw UsageError("-o -: standard output is a terminal; send it to a file or a pipe");
    return;
  }
  if (!is_writable_image(output.path))
    throw UsageError(
        fmt::format("-o: {}: unknown format; use .png, .jpg, .tif, .ppm, .exr, .hdr or .pfm", output.path.string()));
  check_writable(output.path);
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code status;
  return fs::equivalent(a, b, status) && !status;
}

}  // namespace

std::vector<Output> plan_outputs(const std::vector<std::string>& names, const fs::path& input) {
  std::vector<Output> outputs;
  for (const std::string& name : names) outputs.push_back({name});
  if (outputs.empty()) outputs.push_back({input.stem().string() + ".png"});
  for (const Output& output : outputs) check_output(output);
  if (std::ranges::count_if(outputs, &Output::is_standard_output) > 1)
    throw UsageError("-o -: standard output can be used only once");
  return outputs;
}

void check_inputs_survive(std::span<const Output> outputs, const fs::path& statistics,
                          std::span<const fs::path> inputs) {
  const auto check = [&](const char* option, const fs::path& file) {
    if (std::ranges::any_of(inputs, [&](const fs::path& input) { return is_same_file(file, input); }))
      throw UsageError(fmt::format("{0}: {1} is a file that the scene is made of; choose another name with {0}", option,
                                   file.string()));
  };
  for (const Output& output : outputs) check("-o", output.path);
  check("--stats", statistics);
}

void check_input_survives(std::span<const Output> outputs, const fs::path& input) {
  for (const Output& output : outputs)
    if (is_same_file(output.path, input))
      throw UsageError(fmt::format("-o: {} is the input itself; choose another name with -o", output.path.string()));
}

void write_outputs(std::span<const Output> outputs, const Image& linear, const DisplayOptions& display,
                   const ImageMetadata& metadata, const LayerOutputs& further) {
  std::exception_ptr first_error;
  const auto attempt = [&](const auto& write) {
    try {
      write();
    } catch (const OutputError&) {
      if (!first_error) first_error = std::current_exception();
    }
  };
  const auto layers = further.files.empty() ? further.layers : std::span<const ImageLayer>();
  for (const Output& output : outputs) attempt([&] { write_output(output, linear, display, metadata, layers); });
  for (std::size_t i = 0; i < further.files.size(); ++i)
    attempt([&] { write_layers(further.files[i].path, further.layers.subspan(i, 1), metadata); });
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace candil

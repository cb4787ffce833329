#include "io/image_input.h"

#include <stdexcept>
#include <string_view>

namespace candil {
namespace {

const char* library_name(ImageFormat format) {
  switch (format) {
    case ImageFormat::png:
      return "png";
    case ImageFormat::jpeg:
      return "jpeg";
    case ImageFormat::webp:
      return "webp";
    case ImageFormat::hdr:
      return "hdr";
    case ImageFormat::exr:
      return "openexr";
    case ImageFormat::tiff:
      return "tiff";
    case ImageFormat::avif:
      return "heif";
    case ImageFormat::pfm:
    case ImageFormat::ppm:
      break;  // read without the library
  }
  return "";
}

}  // namespace

std::string first_line(const std::string& message) {
  std::string line = message.substr(0, message.find('\n'));
  // What is decoded in memory is not a file of that name.
  for (const std::string_view words : {" (\"memory\")", " from image file \"memory\"", " \"memory\""}) {
    if (const std::size_t start = line.find(words); start != std::string::npos) line.erase(start, words.size());
  }
  return line.empty() ? "the data is damaged" : line;
}

void check_size(const OIIO::ImageSpec& spec, std::size_t encoded_bytes) {
  if (spec.depth > 1 || spec.nchannels < 1) throw std::runtime_error("image without pixels");
  check_image_size(spec.width, spec.height, encoded_bytes);
}

void check_kind(const OIIO::ImageSpec& spec) {
  if (spec.deep) throw std::runtime_error("deep images are not supported");
  const std::string color_space = spec.get_string_attribute("jpeg:ColorSpace");
  if (color_space == "CMYK" || color_space == "YCbCrK")
    throw std::runtime_error("CMYK colours are not supported; convert the image to RGB");
  if (spec.width != spec.full_width || spec.height != spec.full_height)
    throw std::runtime_error("the data window is not the display window (cropped image)");
  // The library divides by this number, whatever the format.
  if (spec.get_int_attribute("tiff:RowsPerStrip", 1) < 1) throw std::runtime_error("strips of no rows");
}

bool can_read(ImageFormat format) {
  const std::string_view name = library_name(format);
  if (name.empty()) return true;
  // Names between commas; those of plugins that could not be loaded are not among them.
  const std::string names = "," + std::string(OIIO::get_string_attribute("input_format_list")) + ",";
  return names.find("," + std::string(name) + ",") != std::string::npos;
}

std::unique_ptr<OIIO::ImageInput> create_image_input(ImageFormat format) {
  // Created by the name of its format: opening by a file name would go on to try every plugin there is.
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(library_name(format));
  if (!input) {
    OIIO::geterror();
    switch (format) {
      case ImageFormat::avif:
        throw std::runtime_error("this OpenImageIO cannot read AVIF: it has no libheif");
      case ImageFormat::webp:
        throw std::runtime_error("this OpenImageIO cannot read WebP: it has no libwebp");
      default:
        throw std::runtime_error(std::string("this OpenImageIO cannot read ") + library_name(format));
    }
  }
  return input;
}

namespace {

/// How every image is opened; what is not asked for here is the library's default.
void open_input(OIIO::ImageInput& input, const std::string& name, OIIO::ImageSpec& spec) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input.open(name, spec, config)) throw std::runtime_error(first_line(input.geterror()));
}

}  // namespace

void open_image(OIIO::ImageInput& input, OIIO::Filesystem::IOProxy& file, OIIO::ImageSpec& spec) {
  if (!input.set_ioproxy(&file)) throw std::runtime_error(first_line(input.geterror()));
  open_input(input, "memory", spec);
}

void open_image(OIIO::ImageInput& input, const TemporaryFile& file, OIIO::ImageSpec& spec) {
  open_input(input, file.path(), spec);
}

}  // namespace candil

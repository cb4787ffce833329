/// Reads the pixels of an image to where they are wanted. Only for .cpp files of io/: sees OpenImageIO.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "io/image_decoder.h"
#include "io/temporary_file.h"

namespace candil {

/// An encoded image in memory, which outlives this, opened and found fit to be decoded.
class ImageReader {
 public:
  /// Not for PFM and PPM. Throws std::runtime_error with one line that does not name the file.
  ImageReader(std::span<const std::byte> encoded, ImageFormat format);

  int width() const { return spec_.width; }
  int height() const { return spec_.height; }
  /// Of the picture, 1 to 4: grey or RGB, then alpha.
  int channels() const { return channels_; }
  bool is_8_bit() const;
  bool is_linear() const;        ///< See DecodedImage.
  bool is_unassociated() const;  ///< See DecodedImage.

  /// Decodes, once, into rows from top to bottom of pixels that are `stride` >= channels() values apart; values between
  /// them stay as they are. Bytes for images of 8 bits a channel, floats for any. Throws like the constructor.
  void read(std::uint8_t* pixels, int stride);
  void read(float* pixels, int stride);

 private:
  template <typename Value>
  void read_as(OIIO::TypeDesc type, Value* pixels, int stride);
  bool has_multiplied_webp() const;

  ImageFormat format_;
  std::vector<std::byte> png_;  // without the chunks that make no pixels
  std::span<const std::byte> encoded_;
  OIIO::Filesystem::IOMemReader memory_;
  std::optional<TemporaryFile> copy_;
  std::unique_ptr<OIIO::ImageInput> input_;  // reads the above, goes first
  OIIO::ImageSpec spec_;
  int first_channel_ = 0, channels_ = 0;
};

}  // namespace candil

#include "io/image_avif.h"

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/av1_size.h"
#include "io/image_decoder.h"

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail() { throw std::runtime_error("the AVIF file is damaged"); }

/// Takes big-endian numbers and texts off the front of the bytes; fails where there are too few.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t size) {
    std::uint64_t value = 0;
    for (const std::byte byte : take(size)) value = value << 8 | std::to_integer<std::uint64_t>(byte);
    return value;
  }
  std::string_view name() { return {reinterpret_cast<const char*>(take(4).data()), 4}; }
  Bytes take(std::size_t size) {
    if (size > bytes_.size()) fail();
    const Bytes taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }
  Bytes rest() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Calls `visit(name, payload)` for the boxes one after the other (ISO/IEC 14496-12, section 4.2).
template <typename Visit>
void for_each_box(Bytes bytes, const Visit& visit) {
  ByteReader reader(bytes);
  while (!reader.rest().empty()) {
    std::uint64_t size = reader.number(4), head = 8;
    const std::string_view name = reader.name();
    if (size == 1) size = reader.number(8), head = 16;
    if (size == 0) size = head + reader.rest().size();  // to the end
    if (size < head) fail();
    visit(name, reader.take(size - head));
  }
}

/// The same in a box that begins with a version, flags and `more` bytes.
template <typename Visit>
void for_each_box_within(Bytes payload, std::size_t more, const Visit& visit) {
  ByteReader reader(payload);
  reader.take(4 + more);
  for_each_box(reader.rest(), visit);
}

/// What the boxes of `meta` say of the file's items.
struct Items {
  std::map<std::uint64_t, std::string> types;  ///< By id.
  Bytes locations, data;                       ///< Payloads of iloc and idat.
  bool has_size = false;
};

/// Section 8.11.6: an item's id and type.
void read_item(Bytes payload, Items& items) {
  ByteReader reader(payload);
  const std::uint64_t version = reader.number(1);
  reader.take(3);
  if (version < 2) fail();
  const std::uint64_t id = reader.number(version == 2 ? 2 : 4);
  reader.take(2);
  const std::string_view type = reader.name();
  if (type == "grid" || type == "iovl") throw std::runtime_error("AVIF put together of several pictures");
  if (type != "av01" && type != "Exif" && type != "mime" && type != "uri ")
    throw std::runtime_error("AVIF that is not coded as AV1");
  if (!items.types.try_emplace(id, type).second) fail();
}

/// ISO/IEC 23008-12, section 6.5.3: the size of an item's picture.
void read_property(std::string_view name, Bytes payload, std::size_t encoded_bytes, Items& items) {
  if (name == "hvcC" || name == "vvcC") throw std::runtime_error("AVIF that is not coded as AV1");
  if (name != "ispe") return;
  ByteReader reader(payload);
  reader.take(4);
  const auto width = static_cast<std::int64_t>(reader.number(4)), height = static_cast<std::int64_t>(reader.number(4));
  check_image_size(width, height, encoded_bytes);
  items.has_size = true;
}

Items read_meta(Bytes payload, std::size_t encoded_bytes) {
  Items items;
  for_each_box_within(payload, 0, [&](std::string_view name, Bytes box) {
    // Once each, so that no other reader takes another one.
    if ((name == "iloc" && !items.locations.empty()) || (name == "idat" && !items.data.empty())) fail();
    if (name == "iloc") items.locations = box;
    if (name == "idat") items.data = box;
    if (name == "iinf") {
      const std::size_t count_bytes = !box.empty() && box[0] == std::byte{0} ? 2 : 4;
      for_each_box_within(box, count_bytes, [&](std::string_view, Bytes item) { read_item(item, items); });
    }
    if (name != "iprp") return;
    for_each_box(box, [&](std::string_view container, Bytes properties) {
      if (container != "ipco") return;
      for_each_box(properties, [&](std::string_view property, Bytes value) {
        read_property(property, value, encoded_bytes, items);
      });
    });
  });
  return items;
}

/// Calls `visit(id, bytes)` for the data of each item (ISO/IEC 14496-12, section 8.11.3).
template <typename Visit>
void for_each_item(Bytes file, const Items& items, const Visit& visit) {
  ByteReader reader(items.locations);
  const std::uint64_t version = reader.number(1);
  reader.take(3);
  if (version > 2) fail();
  const std::uint64_t sizes = reader.number(2);
  const std::size_t offset_bytes = sizes >> 12, length_bytes = sizes >> 8 & 15, base_bytes = sizes >> 4 & 15,
                    index_bytes = version == 0 ? 0 : sizes & 15;
  if (offset_bytes > 8 || length_bytes > 8 || base_bytes > 8 || index_bytes > 8) fail();
  const std::uint64_t count = reader.number(version < 2 ? 2 : 4);
  std::size_t total = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t id = reader.number(version < 2 ? 2 : 4);
    const std::uint64_t method = version == 0 ? 0 : reader.number(2) & 15;
    if (method > 1) fail();
    reader.take(2);
    const std::uint64_t base = reader.number(base_bytes), extents = reader.number(2);
    const Bytes source = method == 0 ? file : items.data;
    std::vector<std::byte> bytes;
    for (std::uint64_t k = 0; k < extents; ++k) {
      reader.take(index_bytes);
      const std::uint64_t offset = reader.number(offset_bytes), length = reader.number(length_bytes);
      // Items do not share bytes: many that name the same ones are not to take time and memory.
      total += length;
      if (length == 0 || base > source.size() || offset > source.size() - base ||
          length > source.size() - base - offset || total > file.size())
        fail();
      const Bytes extent = source.subspan(base + offset, length);
      bytes.insert(bytes.end(), extent.begin(), extent.end());
    }
    visit(id, bytes);
  }
}

}  // namespace

bool is_avif(Bytes encoded) {
  if (encoded.size() < 16) return false;
  ByteReader reader(encoded);
  const std::uint64_t size = reader.number(4);
  if (reader.name() != "ftyp" || size < 16 || size > encoded.size()) return false;
  ByteReader brands(reader.take(size - 8));
  while (brands.rest().size() >= 4)
    if (brands.name() == "avif") return true;
  return false;
}

void check_avif(Bytes encoded) {
  bool has_picture = false;
  for_each_box(encoded, [&](std::string_view name, Bytes payload) {
    if (name == "moov") throw std::runtime_error("AVIF of a film, not a picture");
    if (name != "meta") return;
    const Items items = read_meta(payload, encoded.size());
    if (!items.has_size) fail();
    for_each_item(encoded, items, [&](std::uint64_t id, Bytes data) {
      const auto type = items.types.find(id);
      if (type == items.types.end()) fail();
      if (type->second != "av01") return;
      for (const auto& [width, height] : av1_sizes(data)) {
        check_image_size(width, height, encoded.size());
        has_picture = true;
      }
    });
  });
  if (!has_picture) fail();
}

}  // namespace candil

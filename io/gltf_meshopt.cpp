#include "io/gltf_meshopt.h"

#include "io/error.h"

#ifdef CANDIL_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace candil {

namespace {

/// No stream holds more than so many bytes of elements for each of its own. In mode ATTRIBUTES, version 0 spends 2 bits
/// on 16 equal bytes, version 1 a byte on 4 columns of 256 of them; a triangle takes a byte, an index another.
std::size_t most_expansion(std::string_view mode) { return mode == "ATTRIBUTES" ? 1024 : 12; }

}  // namespace

void check_meshopt_view(const MeshoptView& view, const std::string& name, const std::string& place) {
  const auto fail = [&](const char* property, const std::string& message) {
    throw InputError(name, place + "." + property, message);
  };
  const bool is_attributes = view.mode == "ATTRIBUTES";
  if (is_attributes && (view.stride < 4 || view.stride > 256 || view.stride % 4 != 0)) {
    fail("byteStride", "must be 4, 8, ... or 256 in mode ATTRIBUTES, not " + std::to_string(view.stride));
  }
  if (!is_attributes && view.stride != 2 && view.stride != 4) {
    fail("byteStride", "must be 2 or 4 in mode " + view.mode + ", not " + std::to_string(view.stride));
  }
  if (view.mode == "TRIANGLES" && view.count % 3 != 0) {
    fail("count", "must be a multiple of 3 in mode TRIANGLES, not " + std::to_string(view.count));
  }
  if (!is_attributes && view.filter != "NONE") fail("filter", "must be NONE in mode " + view.mode);
  const bool is_small = view.stride == 4 || view.stride == 8;
  if (((view.filter == "OCTAHEDRAL" || view.filter == "COLOR") && !is_small) ||
      (view.filter == "QUATERNION" && view.stride != 8)) {
    fail("byteStride", "of " + std::to_string(view.stride) + " does not go with the filter " + view.filter);
  }
  if (view.view_stride != 0 && view.view_stride != view.stride) {
    fail("byteStride",
         "is " + std::to_string(view.stride) + ", that of the view is " + std::to_string(view.view_stride));
  }
  // The count is below 2^49, the stride at most 256.
  if (view.count * view.stride != view.view_bytes) {
    fail("count", "makes " + std::to_string(view.count * view.stride) + " bytes, the byteLength of the view is " +
                      std::to_string(view.view_bytes));
  }
  if (view.view_bytes / most_expansion(view.mode) > view.compressed.size()) {
    fail("byteLength", "is too short for " + std::to_string(view.view_bytes) + " bytes of elements");
  }
}

#ifdef CANDIL_HAS_MESHOPTIMIZER

namespace {

constexpr int codec_1_since = 230, color_filter_since = 250;  // MESHOPTIMIZER_VERSION: 230 is 0.23

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

void apply_filter(const MeshoptView& view, Bytes& elements) {
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(elements.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(elements.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(elements.data(), view.count, view.stride);
#if MESHOPTIMIZER_VERSION >= 250
  if (view.filter == "COLOR") meshopt_decodeFilterColor(elements.data(), view.count, view.stride);
#endif
}

int decode(const MeshoptView& view, Bytes& elements) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(view.compressed.data());
  const std::size_t size = view.compressed.size();
  if (view.mode == "TRIANGLES") return meshopt_decodeIndexBuffer(elements.data(), view.count, view.stride, bytes, size);
  if (view.mode == "INDICES") return meshopt_decodeIndexSequence(elements.data(), view.count, view.stride, bytes, size);
  return meshopt_decodeVertexBuffer(elements.data(), view.count, view.stride, bytes, size);
}

}  // namespace

bool has_meshopt() { return true; }

Bytes decode_meshopt(const MeshoptView& view, const std::string& name, const std::string& place) {
  const auto needs = [&](const std::string& what, int since) {
    throw InputError(name, place,
                     "uses " + what + ", which needs meshoptimizer " + version_text(since) +
                         " or newer; this program was built with " + version_text(MESHOPTIMIZER_VERSION));
  };
  constexpr std::byte codec_1{0xA1};
  const bool is_attributes = view.mode == "ATTRIBUTES",
             is_codec_1 = is_attributes && !view.compressed.empty() && view.compressed[0] == codec_1;
  if (is_codec_1 && MESHOPTIMIZER_VERSION < codec_1_since) needs("version 1 of the vertex codec", codec_1_since);
  if (view.filter == "COLOR" && MESHOPTIMIZER_VERSION < color_filter_since) {
    needs("the filter COLOR", color_filter_since);
  }
  Bytes elements(view.view_bytes);
  if (view.count == 0) return elements;
  if (decode(view, elements) != 0) throw InputError(name, place, "the compressed data is damaged");
  apply_filter(view, elements);
  return elements;
}

#else

bool has_meshopt() { return false; }

Bytes decode_meshopt(const MeshoptView&, const std::string& name, const std::string& place) {
  throw InputError(name, place,
                   "this program was built without meshoptimizer (Debian and Ubuntu: libmeshoptimizer-dev)");
}

#endif

}  // namespace candil

#include "io/gltf_buffers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/error.h"
#include "io/gltf_meshopt.h"

namespace candil {

namespace {

using nlohmann::json;

const json& array_of(const json& root, const char* property) {
  static const json none = json::array();
  const auto found = root.find(property);
  return found == root.end() ? none : *found;
}

constexpr const char* meshopt_names[] = {"KHR_meshopt_compression", "EXT_meshopt_compression"};

/// The compression of a view or buffer and the extension's name; null if there is none that this program can undo.
std::pair<const json*, std::string> find_meshopt(const json& object) {
  const auto extensions = object.find("extensions");
  if (!has_meshopt() || extensions == object.end()) return {};
  for (const char* name : meshopt_names) {
    const auto found = extensions->find(name);
    if (found != extensions->end()) return {&*found, name};
  }
  return {};
}

/// Whether a buffer may go without bytes where the views into it are decompressed.
bool is_meshopt_fallback(const json& buffer) {
  const auto extensions = buffer.find("extensions");
  return extensions != buffer.end() && std::ranges::any_of(meshopt_names, [&](const char* name) {
           return extensions->contains(name) && extensions->at(name).value("fallback", false);
         });
}

class BufferReader {
 public:
  BufferReader(const json& root, const GltfContainer& container, const std::filesystem::path& folder,
               const std::string& name, std::vector<std::filesystem::path>& files)
      : buffers_(array_of(root, "buffers")),
        views_(array_of(root, "bufferViews")),
        container_(container),
        folder_(folder),
        name_(name),
        files_(files) {}

  GltfBuffers read() {
    const std::vector<bool> is_needed = find_needed();
    result_.owned.reserve(buffers_.size() + views_.size());  // spans into its elements' bytes must stay valid
    for (std::size_t b = 0; b < buffers_.size(); ++b) {
      bytes_.push_back(is_needed[b] ? load(b) : std::span<const std::byte>());
      result_.total_bytes += bytes_.back().size();
    }
    for (std::size_t v = 0; v < views_.size(); ++v) read_view(v);
    decompress();
    return std::move(result_);
  }

 private:
  struct CompressedView {
    std::size_t index;
    std::string place;
    MeshoptView meshopt;
    Bytes elements;
    std::exception_ptr error;
  };

  /// False for buffers that are marked as fallbacks or that compressed views refer to, and no other views.
  std::vector<bool> find_needed() const {
    std::vector<bool> is_read(buffers_.size()), is_fallback(buffers_.size());
    for (std::size_t b = 0; b < buffers_.size(); ++b) {
      const json* mark = find_meshopt(buffers_[b]).first;
      is_fallback[b] = mark != nullptr && mark->value("fallback", false);
    }
    for (const json& view : views_) {
      const json* meshopt = find_meshopt(view).first;
      if (meshopt != nullptr) is_fallback[view.at("buffer").get<std::size_t>()] = true;
      is_read[(meshopt != nullptr ? *meshopt : view).at("buffer").get<std::size_t>()] = true;
    }
    for (std::size_t b = 0; b < buffers_.size(); ++b) is_read[b] = is_read[b] || !is_fallback[b];
    return is_read;
  }

  std::span<const std::byte> load(std::size_t index) {
    const json& buffer = buffers_[index];
    const std::string place = "buffers[" + std::to_string(index) + "]";
    std::span<const std::byte> bytes;
    if (buffer.contains("uri")) {
      bytes = result_.owned.emplace_back(
          read_reference(folder_, buffer.at("uri").get_ref<const std::string&>(), name_, place + ".uri", files_));
    } else if (index == 0 && container_.binary) {
      bytes = *container_.binary;
    } else {
      if (is_meshopt_fallback(buffer) && !has_meshopt())
        decode_meshopt({}, name_, place);  // which says what is missing
      throw InputError(name_, place, "has no uri and the file no binary chunk for it");
    }
    const auto length = buffer.at("byteLength").get<std::size_t>();
    if (length > bytes.size()) {
      throw InputError(name_, place + ".byteLength",
                       "declares " + std::to_string(length) + " bytes, there are " + std::to_string(bytes.size()));
    }
    return bytes.first(length);
  }

  /// `object`: a view, or its compression. Checked against the declared length of the buffer.
  std::pair<std::size_t, std::size_t> find_range(const json& object, const std::string& place) const {
    const auto buffer = object.at("buffer").get<std::size_t>();
    const auto offset = object.value("byteOffset", std::size_t{0}), length = object.at("byteLength").get<std::size_t>();
    const auto available = buffers_[buffer].at("byteLength").get<std::size_t>();
    // Neither exceeds 2^48, hence no overflow.
    if (offset + length > available) {
      throw InputError(
          name_, place,
          "reads " + std::to_string(offset + length - available) + " bytes beyond buffer " + std::to_string(buffer));
    }
    return {offset, length};
  }

  std::span<const std::byte> slice(const json& object, const std::string& place) const {
    const auto [offset, length] = find_range(object, place);
    return bytes_[object.at("buffer").get<std::size_t>()].subspan(offset, length);
  }

  void read_view(std::size_t index) {
    const json& view = views_[index];
    const std::string place = "bufferViews[" + std::to_string(index) + "]";
    const auto stride = view.value("byteStride", std::size_t{0});
    // Specification, section 5.11.4; exporters that write 0 mean none.
    if (stride % 4 != 0 || stride > 252) {
      throw InputError(name_, place + ".byteStride", "must be 4, 8, ... or 252, not " + std::to_string(stride));
    }
    const auto [meshopt, extension] = find_meshopt(view);
    if (meshopt == nullptr) {
      result_.views.push_back(slice(view, place));
      return;
    }
    CompressedView& compressed = compressed_.emplace_back();
    compressed.index = index;
    compressed.place = place + ".extensions." + extension;
    compressed.meshopt.compressed = slice(*meshopt, compressed.place);
    compressed.meshopt.count = meshopt->at("count").get<std::size_t>();
    compressed.meshopt.stride = meshopt->at("byteStride").get<std::size_t>();
    compressed.meshopt.mode = meshopt->at("mode").get<std::string>();
    compressed.meshopt.filter = meshopt->value("filter", "NONE");
    compressed.meshopt.view_bytes = find_range(view, place).second;
    compressed.meshopt.view_stride = stride;
    check_meshopt_view(compressed.meshopt, name_, compressed.place);
    result_.views.emplace_back();
  }

  void decompress() {
    // Views may share their compressed bytes: a small file could name them any number of times.
    constexpr std::size_t least = std::size_t{1} << 30, factor = 64;
    std::size_t bytes_left = std::max(least, factor * result_.total_bytes);
    for (const CompressedView& view : compressed_) {
      if (view.meshopt.view_bytes > bytes_left) {
        throw InputError(name_, view.place, "expands to far more than the file has bytes for");
      }
      bytes_left -= view.meshopt.view_bytes;
    }
    tbb::parallel_for(std::size_t{0}, compressed_.size(), [&](std::size_t i) {
      CompressedView& view = compressed_[i];
      try {
        view.elements = decode_meshopt(view.meshopt, name_, view.place);
      } catch (...) {
        view.error = std::current_exception();
      }
    });
    for (CompressedView& view : compressed_) {
      if (view.error) std::rethrow_exception(view.error);
      result_.views[view.index] = result_.owned.emplace_back(std::move(view.elements));
    }
  }

  const json& buffers_;
  const json& views_;
  const GltfContainer& container_;
  const std::filesystem::path& folder_;
  const std::string& name_;
  std::vector<std::filesystem::path>& files_;
  std::vector<std::span<const std::byte>> bytes_;  // of the buffers that are needed
  std::vector<CompressedView> compressed_;
  GltfBuffers result_;
};

}  // namespace

GltfBuffers read_gltf_buffers(const json& root, const GltfContainer& container, const std::filesystem::path& folder,
                              const std::string& name, std::vector<std::filesystem::path>& files) {
  return BufferReader(root, container, folder, name, files).read();
}

}  // namespace candil

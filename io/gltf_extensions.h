/// Which glTF extensions candil knows, and how well. One table says it all: what is read, what a file may require, what
/// `info` and --list-extensions tell.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_contents.h"
#include "io/image_decoder.h"

namespace candil {

enum class GltfTier {
  full,          ///< Read, and rendered as its text has it.
  partial,       ///< Read, but approximated or with parts missing.
  harmless,      ///< Not read; by its own text it cannot change a still image of the default state.
  experimental,  ///< Only with a switch.
  unsupported,
};

struct GltfExtension {
  std::string_view name;
  GltfTier tier;
  std::string_view remark = {};           ///< What is approximated, missing or ignored, in a few words.
  std::string_view missing_package = {};  ///< Without which this build does not have it.
  std::optional<ImageFormat> image = {};  ///< What its images are, where OpenImageIO may lack a reader of them.

  /// One of: full, partial, ignored, experimental, unsupported, unavailable (for want of a package).
  std::string_view tier_word() const;
  /// The remark and the missing package, in a few words; may be empty.
  std::string explanation() const;
  /// Whether this build reads and renders it.
  bool is_honoured() const { return (tier == GltfTier::full || tier == GltfTier::partial) && missing_package.empty(); }
};

/// All that candil knows of, by name.
std::span<const GltfExtension> gltf_extensions();

/// The same with an OpenImageIO that has readers for the formats of which `has_reader` is true.
std::vector<GltfExtension> gltf_extensions_with(const std::function<bool(ImageFormat)>& has_reader);

/// Experimental extensions that are turned on, by name.
using Experiments = std::span<const std::string>;
inline bool is_turned_on(std::string_view extension, Experiments experiments) {
  return std::find(experiments.begin(), experiments.end(), extension) != experiments.end();
}

/// Read and rendered.
bool is_supported_gltf_extension(std::string_view extension, Experiments experiments = {});

/// May be ignored even when a file requires it.
bool is_harmless_gltf_extension(std::string_view extension);

/// The end of a sentence about an extension that is not honoured: "not supported and ignored", or what it is ignored
/// for want of.
std::string why_gltf_extension_is_ignored(std::string_view extension);

/// Why a picture may lack what the extension says; nothing if it is rendered in full.
std::optional<NotHonoured> what_is_not_honoured(const std::string& extension, Experiments experiments = {});

/// What pictures lack beside extensions.
std::vector<NotHonoured> parts_not_honoured(const GltfContents& contents, bool has_point_radius);

/// Throws InputError(name, "extensionsRequired", ...) that names every extension that is neither of the two.
void refuse_unknown_gltf_extensions(const std::vector<std::string>& required, const std::string& name,
                                    Experiments experiments = {});

}  // namespace candil

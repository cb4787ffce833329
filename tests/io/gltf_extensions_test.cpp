// The table of extensions.
#include "io/gltf_extensions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "io/error.h"
#include "tests/io/image_samples.h"
#include "tests/support/gltf/ktx2_sample.h"

namespace candil {
namespace {

TEST(GltfExtensions, AreSortedAndNamedOnce) {
  const auto table = gltf_extensions();
  const auto not_after = [](const GltfExtension& a, const GltfExtension& b) { return a.name >= b.name; };
  EXPECT_EQ(std::adjacent_find(table.begin(), table.end(), not_after), table.end());
}

TEST(GltfExtensions, WhatIsNotInFullSaysWhy) {
  for (const GltfExtension& extension : gltf_extensions()) {
    if (extension.tier == GltfTier::partial || extension.tier == GltfTier::harmless) {
      EXPECT_FALSE(extension.remark.empty()) << extension.name;
    }
  }
}

TEST(GltfExtensions, WithoutTheirPackageAreNotHonoured) {
  const GltfExtension with{"A", GltfTier::full, "x"}, without{"A", GltfTier::full, "x", "libx-dev"};
  EXPECT_TRUE(with.is_honoured());
  EXPECT_EQ(with.tier_word(), "full");
  EXPECT_FALSE(without.is_honoured());
  EXPECT_EQ(without.tier_word(), "unavailable");
  EXPECT_EQ(without.explanation(), "this build has no libx-dev; x");
}

// Whatever the table says of an extension, the loader does.
TEST(GltfExtensions, RequiredOnesAreRefusedUnlessHonouredOrHarmless) {
  for (const GltfExtension& extension : gltf_extensions()) {
    const std::vector<std::string> required{std::string(extension.name)};
    if (extension.is_honoured() || extension.tier == GltfTier::harmless) {
      EXPECT_NO_THROW(refuse_unknown_gltf_extensions(required, "a.gltf")) << extension.name;
    } else {
      EXPECT_THROW(refuse_unknown_gltf_extensions(required, "a.gltf"), InputError) << extension.name;
    }
    EXPECT_EQ(what_is_not_honoured(required[0]).has_value(), extension.tier_word() != "full") << extension.name;
  }
  EXPECT_EQ(what_is_not_honoured("ACME_paint")->reason, "unsupported");
}

TEST(GltfExtensions, AreUnavailableWhereOpenImageIoHasNoReader) {
  const std::vector<GltfExtension> with_all = gltf_extensions_with([](ImageFormat) { return true; });
  const std::vector<GltfExtension> without =
      gltf_extensions_with([](ImageFormat format) { return format != ImageFormat::webp; });
  ASSERT_EQ(with_all.size(), without.size());
  for (std::size_t i = 0; i < without.size(); ++i) {
    const bool is_webp = without[i].name == "EXT_texture_webp";
    EXPECT_EQ(without[i].is_honoured(), with_all[i].is_honoured() && !is_webp) << without[i].name;
    if (!is_webp) continue;
    EXPECT_EQ(with_all[i].tier_word(), "full");
    EXPECT_EQ(without[i].tier_word(), "unavailable");
    EXPECT_EQ(without[i].explanation(), "this build has no OpenImageIO with libwebp");
  }
}

// The table says it by the library's list of formats, this by what becomes of a picture.
TEST(GltfExtensions, OfImagesAreHonouredIfOneCanBeDecoded) {
  const auto can_decode = [](std::span<const std::byte> encoded, ImageFormat format) {
    try {
      return decode_image(encoded, format).width > 0;
    } catch (const std::runtime_error&) {
      return false;
    }
  };
  EXPECT_EQ(is_supported_gltf_extension("EXT_texture_webp"),
            can_decode(test::from_base64(test::webp_rgba8), ImageFormat::webp));
  EXPECT_EQ(is_supported_gltf_extension("EXT_texture_avif"),
            can_decode(test::read_test_data("alpha.avif"), ImageFormat::avif));
}

}  // namespace
}  // namespace candil

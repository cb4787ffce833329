// The table of extensions.
#include "io/gltf_extensions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/error.h"

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

}  // namespace
}  // namespace candil

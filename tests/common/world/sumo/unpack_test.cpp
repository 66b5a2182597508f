// SPDX-License-Identifier: Apache-2.0
// A packed map that fills a disk is refused, and nothing of it is left.
#include "common/world/sumo/unpack.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/sumo/import_file.hpp"

namespace rodeira::sumo {
namespace {

class UnpackTest : public testing::Test {
 protected:
  std::filesystem::path Gzipped(const std::string& name, const std::string& text, std::size_t blanks) const {
    const std::filesystem::path path = folder_.path() / name;
    const gzFile file = ::gzopen(path.c_str(), "wb9");
    EXPECT_GT(::gzwrite(file, text.data(), static_cast<unsigned>(text.size())), 0);
    const std::string block(std::size_t{1} << 20, ' ');
    for (std::size_t i = 0; i < blanks; ++i) EXPECT_GT(::gzwrite(file, block.data(), 1 << 20), 0);
    EXPECT_EQ(::gzclose(file), Z_OK);
    return path;
  }
  base::TemporaryFolder folder_ = std::move(base::TemporaryFolder::Make("unpack-test")).value();
};

TEST_F(UnpackTest, AnHonestFileComesWholeAndABombIsRefused) {
  const std::string text = "<osm version=\"0.6\"></osm>";
  const auto copy = folder_.path() / "copy.osm";
  ASSERT_TRUE(Unpack(Gzipped("map.osm.gz", text, 0), SourceKind::kOpenStreetMap, copy).ok());
  EXPECT_EQ(base::ReadText(copy).value(), text);
  const auto bomb = Unpack(Gzipped("bomb.osm.gz", text, 64), SourceKind::kOpenStreetMap, copy);
  ASSERT_FALSE(bomb.ok());
  EXPECT_EQ(bomb.error().exit_status(), 2);
  EXPECT_THAT(bomb.error().Text(), testing::HasSubstr("this is no map but a"));
  EXPECT_LT(std::filesystem::file_size(copy), std::uintmax_t{32} << 20) << "it was written on";
  EXPECT_FALSE(Unpack(Gzipped("bomb.net.xml.gz", "<net>", 64), SourceKind::kNet, copy).ok());
}

}  // namespace
}  // namespace rodeira::sumo

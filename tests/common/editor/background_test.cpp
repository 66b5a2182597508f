// Pictures come in as PNG, JPEG, BMP and TIFF; what is none is refused; coarser levels are means.
#include "common/editor/background.hpp"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <memory>

#include "common/base/files.hpp"
#include "common/base/temporary_folder.hpp"
#include "common/map/picture.hpp"

namespace rodeira::editor {
namespace {

constexpr int kWidth = 37, kHeight = 23;

std::uint8_t Value(int x, int y, int channel) { return static_cast<std::uint8_t>(2 * x + 3 * y + 20 * channel); }

// A picture of Value, written by GDAL in a kind that it knows.
void Write(const std::filesystem::path& path, const char* kind, int bands) {
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> set(GetGDALDriverManager()->GetDriverByName("MEM")->Create("", kWidth, kHeight, bands, GDT_Byte, nullptr));
  for (int band = 0; band < bands; ++band) {
    std::vector<std::uint8_t> values;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) values.push_back(Value(x, y, band));
    }
    ASSERT_EQ(set->GetRasterBand(band + 1)->RasterIO(GF_Write, 0, 0, kWidth, kHeight, values.data(), kWidth, kHeight, GDT_Byte, 0, 0), CE_None);
  }
  const std::unique_ptr<GDALDataset> written(GetGDALDriverManager()->GetDriverByName(kind)->CreateCopy(path.c_str(), set.get(), FALSE, nullptr, nullptr, nullptr));
  ASSERT_NE(written, nullptr) << kind;
}

class APicture : public testing::TestWithParam<std::tuple<const char*, const char*, int>> {};

TEST_P(APicture, ComesInWithItsPixels) {
  const auto [kind, name, bands] = GetParam();
  auto folder = base::TemporaryFolder::Make("editor");
  ASSERT_TRUE(folder.ok());
  const auto path = folder.value().path() / name;
  Write(path, kind, bands);
  const auto bytes = ImportPicture(path);
  ASSERT_TRUE(bytes.ok()) << bytes.error().Text();
  const auto info = map::ReadPictureInfo(bytes.value());
  ASSERT_TRUE(info) << "neither PNG nor JPEG";
  EXPECT_EQ(info->width_px, kWidth);
  EXPECT_EQ(info->height_px, kHeight);
  const bool as_it_is = std::string(kind) == "PNG" || std::string(kind) == "JPEG";
  EXPECT_TRUE(!as_it_is || bytes.value() == base::ReadText(path).value());
  const auto pixels = DecodePicture(bytes.value());
  ASSERT_TRUE(pixels.ok()) << pixels.error().Text();
  const int tolerance = std::string(kind) == "JPEG" ? 12 : 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(pixels.value().rgb[static_cast<std::size_t>(3 * (y * kWidth + x) + channel)], Value(x, y, bands >= 3 ? channel : 0), tolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, APicture,
                         testing::Values(std::tuple("PNG", "a.png", 3), std::tuple("PNG", "a.png", 4), std::tuple("PNG", "grey.png", 1), std::tuple("JPEG", "a.jpg", 3),
                                         std::tuple("BMP", "a.bmp", 3), std::tuple("GTiff", "a.tif", 3)));

TEST(Background, WhatIsNoPictureIsRefused) {
  auto folder = base::TemporaryFolder::Make("editor");
  ASSERT_TRUE(folder.ok());
  const auto path = folder.value().path() / "letter.png";
  ASSERT_TRUE(base::WriteWhole(path, "Dear Sir or Madam, enclosed you find a picture.").ok());
  const auto letter = ImportPicture(path);
  ASSERT_FALSE(letter.ok());
  EXPECT_NE(letter.error().Text().find("letter.png: this is no picture; a PNG, JPEG, BMP or TIFF file was expected"), std::string::npos) << letter.error().Text();
  EXPECT_NE(ImportPicture(folder.value().path() / "none.png").error().Text().find("no such file"), std::string::npos);
  Write(folder.value().path() / "whole.png", "PNG", 3);
  const std::string whole = base::ReadText(folder.value().path() / "whole.png").value();
  const auto all = DecodePicture(whole);
  ASSERT_TRUE(all.ok());
  int refused = 0;
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const auto part = DecodePicture(whole.substr(0, length));
    if (!part) ++refused;
    EXPECT_TRUE(!part || part.value().rgb == all.value().rgb) << "half a picture of " << length << " bytes";
  }
  EXPECT_GT(refused, 8);
}

TEST(Background, ReadingCanBeStopped) {
  auto folder = base::TemporaryFolder::Make("editor");
  ASSERT_TRUE(folder.ok());
  Write(folder.value().path() / "a.png", "PNG", 3);
  const std::string bytes = base::ReadText(folder.value().path() / "a.png").value();
  EXPECT_FALSE(DecodePicture(bytes, [](double) { return false; }).ok());
  double last = 0.0;
  EXPECT_TRUE(DecodePicture(bytes, [&](double share) { return last = share, true; }).ok());
  EXPECT_EQ(last, 1.0);
}

TEST(Pyramid, EachLevelHasTheMeansOfTheOneBefore) {
  Pixels pixels{1301, 700, {}};
  for (int i = 0; i < 3 * 1301 * 700; ++i) pixels.rgb.push_back(static_cast<std::uint8_t>((i * 37) % 251));
  const Pyramid pyramid(pixels);
  ASSERT_EQ(pyramid.levels(), 3u);
  EXPECT_EQ(pyramid.level(1).width_px, 651);
  EXPECT_EQ(pyramid.level(1).height_px, 350);
  EXPECT_EQ(pyramid.level(2).width_px, 326);
  const auto at = [](const Pixels& p, int x, int y, int c) { return int(p.rgb[std::size_t(3 * (y * p.width_px + x) + c)]); };
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(17, 300), std::pair(649, 349)}) {
    const int sum = at(pyramid.level(0), 2 * x, 2 * y, 1) + at(pyramid.level(0), 2 * x + 1, 2 * y, 1) + at(pyramid.level(0), 2 * x, 2 * y + 1, 1) + at(pyramid.level(0), 2 * x + 1, 2 * y + 1, 1);
    EXPECT_EQ(at(pyramid.level(1), x, y, 1), (sum + 2) / 4);
  }
  EXPECT_EQ(pyramid.LevelFor(3.0), 0u);
  EXPECT_EQ(pyramid.LevelFor(0.51), 0u);
  EXPECT_EQ(pyramid.LevelFor(0.5), 1u);
  EXPECT_EQ(pyramid.LevelFor(0.01), 2u);
}

}  // namespace
}  // namespace rodeira::editor

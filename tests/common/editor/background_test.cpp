// SPDX-License-Identifier: Apache-2.0
// Pictures come in as PNG, JPEG, BMP and TIFF; what is none is refused; coarser levels are means.
#include "common/editor/background.hpp"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <memory>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/world/traffic_map/picture.hpp"

namespace rodeira::editor {
namespace {

constexpr int kWidth = 37, kHeight = 23;

Pixels Patterned(int width_px, int height_px) {
  Pixels pixels{width_px, height_px, {}};
  for (int i = 0; i < 3 * width_px * height_px; ++i) pixels.rgb.push_back(static_cast<std::uint8_t>((i * 37) % 251));
  return pixels;
}

std::uint8_t Value(int x, int y, int channel) { return static_cast<std::uint8_t>(2 * x + 3 * y + 20 * channel); }

// A picture of Value, written by GDAL in a kind that it knows.
void Write(const std::filesystem::path& path, const char* kind, int bands) {
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> set(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", kWidth, kHeight, bands, GDT_Byte, nullptr));
  for (int band = 0; band < bands; ++band) {
    std::vector<std::uint8_t> values;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) values.push_back(Value(x, y, band));
    }
    ASSERT_EQ(set->GetRasterBand(band + 1)->RasterIO(GF_Write, 0, 0, kWidth, kHeight, values.data(), kWidth, kHeight,
                                                     GDT_Byte, 0, 0),
              CE_None);
  }
  const std::unique_ptr<GDALDataset> written(GetGDALDriverManager()->GetDriverByName(kind)->CreateCopy(
      path.c_str(), set.get(), FALSE, nullptr, nullptr, nullptr));
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
  const auto info = traffic_map::ReadPictureInfo(bytes.value());
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
        EXPECT_NEAR(pixels.value().rgb[static_cast<std::size_t>(3 * (y * kWidth + x) + channel)],
                    Value(x, y, bands >= 3 ? channel : 0), tolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, APicture,
                         testing::Values(std::tuple("PNG", "a.png", 3), std::tuple("PNG", "a.png", 4),
                                         std::tuple("PNG", "grey.png", 1), std::tuple("JPEG", "a.jpg", 3),
                                         std::tuple("BMP", "a.bmp", 3), std::tuple("GTiff", "a.tif", 3)));

TEST(Background, WhatIsNoPictureIsRefused) {
  auto folder = base::TemporaryFolder::Make("editor");
  ASSERT_TRUE(folder.ok());
  const auto path = folder.value().path() / "letter.png";
  ASSERT_TRUE(base::WriteWhole(path, "Dear Sir or Madam, enclosed you find a picture.").ok());
  const auto letter = ImportPicture(path);
  ASSERT_FALSE(letter.ok());
  EXPECT_NE(letter.error().Text().find("letter.png: this is no picture; a PNG, JPEG, BMP or TIFF file was expected"),
            std::string::npos)
      << letter.error().Text();
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
  const Pyramid pyramid(Patterned(1301, 700));
  ASSERT_EQ(pyramid.levels(), 3u);
  EXPECT_EQ(pyramid.level(1).width_px, 651);
  EXPECT_EQ(pyramid.level(1).height_px, 350);
  EXPECT_EQ(pyramid.level(2).width_px, 326);
  const auto at = [](const Pixels& p, int x, int y, int c) {
    return int(p.rgb[std::size_t(3 * (y * p.width_px + x) + c)]);
  };
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(17, 300), std::pair(649, 349)}) {
    const int sum = at(pyramid.level(0), 2 * x, 2 * y, 1) + at(pyramid.level(0), 2 * x + 1, 2 * y, 1) +
                    at(pyramid.level(0), 2 * x, 2 * y + 1, 1) + at(pyramid.level(0), 2 * x + 1, 2 * y + 1, 1);
    EXPECT_EQ(at(pyramid.level(1), x, y, 1), (sum + 2) / 4);
  }
  EXPECT_EQ(pyramid.LevelFor(3.0), 0u);
  EXPECT_EQ(pyramid.LevelFor(0.51), 0u);
  EXPECT_EQ(pyramid.LevelFor(0.5), 1u);
  EXPECT_EQ(pyramid.LevelFor(0.01), 2u);
}

TEST(Pyramid, GrownInStripsItIsTheSame) {
  for (const auto& [width, height] :
       {std::pair(1301, 701), std::pair(2048, 1025), std::pair(513, 1), std::pair(1, 1400), std::pair(7, 5)}) {
    const Pyramid whole(Patterned(width, height));
    for (const int strip : {1, 3, 256, 5000}) {
      PyramidBuilder builder(width, height);
      const Pixels all = Patterned(width, height);
      for (int rows = 0; rows < height;) {
        const int to = std::min(height, rows + strip);
        std::copy(all.rgb.begin() + 3L * width * rows, all.rgb.begin() + 3L * width * to,
                  builder.finest().rgb.begin() + 3L * width * rows);
        builder.Grow(rows = to);
      }
      const Pyramid grown = std::move(builder).Finish();
      ASSERT_EQ(grown.levels(), whole.levels());
      for (std::size_t level = 0; level < whole.levels(); ++level) {
        EXPECT_EQ(grown.level(level).width_px, Pyramid::SizeAt(width, level));
        EXPECT_TRUE(grown.level(level).rgb == whole.level(level).rgb)
            << width << " by " << height << " in strips of " << strip << ", level " << level;
      }
    }
  }
}

// A photograph's bytes: large forms, 3000 by 2100 pixels.
std::string Photograph(const char* kind) {
  constexpr int kWide = 3000, kHigh = 2100;
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> set(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", kWide, kHigh, 3, GDT_Byte, nullptr));
  std::vector<std::uint8_t> values(static_cast<std::size_t>(kWide) * kHigh);
  for (int band = 1; band <= 3; ++band) {
    for (int y = 0; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x)
        values[static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x)] =
            static_cast<std::uint8_t>(40 * band + x / 40 + y / 40);
    }
    EXPECT_EQ(
        set->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, kWide, kHigh, values.data(), kWide, kHigh, GDT_Byte, 0, 0),
        CE_None);
  }
  auto folder = base::TemporaryFolder::Make("editor");
  const auto path = folder.value().path() / "photo";
  std::unique_ptr<GDALDataset>(GetGDALDriverManager()->GetDriverByName(kind)->CreateCopy(path.c_str(), set.get(), FALSE,
                                                                                         nullptr, nullptr, nullptr))
      .reset();
  return base::ReadText(path, 1u << 26).value();
}

TEST(Pyramid, ReadOnTwoThreadsItIsTheSameAndAJpegIsSeenSooner) {
  for (const char* kind : {"PNG", "JPEG"}) {
    const std::string bytes = Photograph(kind);
    std::shared_ptr<const Pyramid> preview;
    double last = 0.0;
    const auto read = ReadPyramid(
        bytes, [&](double share) { return last = share, true; }, [&](auto small) { preview = std::move(small); });
    ASSERT_TRUE(read.ok()) << read.error().Text();
    EXPECT_EQ(last, 1.0);
    const Pyramid expected(DecodePicture(bytes).value());
    ASSERT_EQ(read.value()->levels(), expected.levels());
    for (std::size_t level = 0; level < expected.levels(); ++level)
      EXPECT_TRUE(read.value()->level(level).rgb == expected.level(level).rgb) << kind << level;
    EXPECT_EQ(preview != nullptr, std::string(kind) == "JPEG");
    if (preview == nullptr) continue;
    EXPECT_EQ(preview->first(), 3u);
    EXPECT_EQ(preview->width_px(), 3000);
    EXPECT_EQ(preview->levels(), std::max<std::size_t>(expected.levels(), 4));
    EXPECT_EQ(preview->LevelFor(1.0), 3u);
    // What it shows is the picture: the level's own means within JPEG's and a pixel's differences.
    double worst = 0.0;
    for (int y = 0; y < 2100; y += 7) {
      for (int x = 0; x < 3000; x += 7) {
        const auto small =
            preview->level(3).rgb[3 * (static_cast<std::size_t>(y / 8) * 375 + static_cast<std::size_t>(x / 8))];
        worst = std::max(worst, std::abs(small - (40.0 + x / 40.0 + y / 40.0)));
      }
    }
    EXPECT_LT(worst, 12.0);
  }
}

TEST(Pyramid, OfABrokenPictureThereIsNone) {
  EXPECT_FALSE(ReadPyramid(Photograph("JPEG").substr(0, 20)).ok());
  EXPECT_FALSE(ReadPyramid("no picture").ok());
  const std::string png = Photograph("PNG");
  EXPECT_FALSE(ReadPyramid(png.substr(0, png.size() / 2)).ok());
  int told = 0;
  EXPECT_FALSE(ReadPyramid(png, [&](double) { return ++told < 3; }).ok());
  EXPECT_EQ(told, 3);
}

}  // namespace
}  // namespace rodeira::editor

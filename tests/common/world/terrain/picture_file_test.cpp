// SPDX-License-Identifier: Apache-2.0
// Pictures that GDAL's own drivers wrote, and one written byte by byte: the same pixels, and where they lie.
#include "common/world/terrain/picture_file.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::terrain {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 3, kHeight = 2;
// Rows from the top.
const std::vector<std::uint8_t> kPixels = {250, 10, 20, 30, 240, 40, 50, 60, 230, 0, 0, 0, 255, 255, 255, 128, 64, 32};

// A picture made in memory and written by a driver.
void Write(const char* driver_name, const std::filesystem::path& path, const std::vector<std::uint8_t>& rgb, int width,
           int height) {
  GDALAllRegister();
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  ASSERT_NE(driver, nullptr) << driver_name;
  const GDALDatasetUniquePtr made(memory->Create("", width, height, 3, GDT_Byte, nullptr));
  for (int band = 0; band < 3; ++band) {
    ASSERT_EQ(made->GetRasterBand(band + 1)->RasterIO(GF_Write, 0, 0, width, height,
                                                      const_cast<std::uint8_t*>(rgb.data()) + band, width, height,
                                                      GDT_Byte, 3, 3 * width, nullptr),
              CE_None);
  }
  const GDALDatasetUniquePtr written(driver->CreateCopy(path.c_str(), made.get(), FALSE, nullptr, nullptr, nullptr));
  ASSERT_NE(written, nullptr) << driver_name;
}

TEST(PictureFile, LosslessFormatsGiveTheirPixels) {
  const cli::TemporaryFolder folder;
  for (const auto& [driver, name] :
       {std::pair("PNG", "a.png"), std::pair("BMP", "a.bmp"), std::pair("GTiff", "a.tif")}) {
    Write(driver, folder.path() / name, kPixels, kWidth, kHeight);
    if (HasFatalFailure()) return;
    const auto picture = ReadPicture(folder.path() / name);
    ASSERT_TRUE(picture.ok()) << picture.error().Text();
    EXPECT_EQ(picture.value().width_px, kWidth);
    EXPECT_EQ(picture.value().height_px, kHeight);
    EXPECT_EQ(picture.value().rgb, kPixels) << name;
  }
}

TEST(PictureFile, AJpegGivesNearlyItsPixels) {
  const cli::TemporaryFolder folder;
  std::vector<std::uint8_t> even;
  for (int i = 0; i < 16 * 16; ++i) even.insert(even.end(), {200, 120, 40});
  Write("JPEG", folder.path() / "a.jpg", even, 16, 16);
  const auto picture = ReadPicture(folder.path() / "a.jpg");
  ASSERT_TRUE(picture.ok()) << picture.error().Text();
  ASSERT_EQ(picture.value().rgb.size(), even.size());
  for (std::size_t i = 0; i < even.size(); ++i) EXPECT_LE(std::abs(picture.value().rgb[i] - even[i]), 4);
}

// Two pixels of a table of two colours, after the format's description: rows from below, each filled up to four bytes.
TEST(PictureFile, ATableOfColoursIsLookedUp) {
  const cli::TemporaryFolder folder;
  std::string bytes = "BM";
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  };
  put(14 + 40 + 8 + 8, 4), put(0, 4), put(14 + 40 + 8, 4);
  put(40, 4), put(1, 4), put(2, 4), put(1, 2), put(8, 2), put(0, 4), put(8, 4), put(0, 4), put(0, 4), put(2, 4),
      put(0, 4);
  bytes += std::string("\x01\x02\x03\x00\x0a\x0b\x0c\x00", 8);  // blue, green, red, nothing
  bytes += std::string("\x01\x00\x00\x00\x00\x00\x00\x00", 8);  // the lower row has the second colour
  const auto file = folder.Write("a.bmp", bytes);
  const auto picture = ReadPicture(file);
  ASSERT_TRUE(picture.ok()) << picture.error().Text();
  EXPECT_EQ(picture.value().rgb, (std::vector<std::uint8_t>{3, 2, 1, 12, 11, 10}));
}

// A world file says the size of a pixel and the middle of the upper left one.
TEST(PictureFile, AWorldFileSaysWhereItLies) {
  const cli::TemporaryFolder folder;
  const auto file = folder.path() / "a.png";
  Write("PNG", file, kPixels, kWidth, kHeight);
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_TRUE(LookAtPicture(file).ok());
  EXPECT_FALSE(LookAtPicture(file).value().place.has_value());
  folder.Write("a.pgw", "10\n0\n0\n-20\n1005\n1990\n");
  const auto facts = LookAtPicture(file);
  ASSERT_TRUE(facts.ok() && facts.value().place.has_value());
  EXPECT_EQ(facts.value().place->west, 1000.0);
  EXPECT_EQ(facts.value().place->east, 1030.0);
  EXPECT_EQ(facts.value().place->north, 2000.0);
  EXPECT_EQ(facts.value().place->south, 1960.0);
  folder.Write("a.pgw", "10\n1\n1\n-20\n1005\n1990\n");  // turned
  EXPECT_FALSE(LookAtPicture(file).value().place.has_value());
}

TEST(PictureFile, WhatIsNoPictureIsRefusedWithASentence) {
  const cli::TemporaryFolder folder;
  const auto text = folder.Write("meadow.jpg", "no picture");
  EXPECT_THAT(LookAtPicture(text).error().Text(),
              HasSubstr("meadow.jpg' is no picture that can be read (JPEG, PNG, BMP, TIFF)"));
  EXPECT_THAT(ReadPicture(folder.path() / "medow.jpg").error().Text(),
              HasSubstr("medow.jpg'; did you mean 'meadow.jpg'?"));
  EXPECT_THAT(ReadPicture(folder.path()).error().Text(), HasSubstr("there is no texture file"));
  // Cut off in the middle of its pixels: the header still says how large it is.
  std::vector<std::uint8_t> noise;
  for (int i = 0; i < 3 * 64 * 64; ++i) noise.push_back(static_cast<std::uint8_t>(i * 7919 >> 3));
  Write("PNG", folder.path() / "whole.png", noise, 64, 64);
  ASSERT_FALSE(HasFatalFailure());
  std::string bytes;
  {
    std::ifstream in(folder.path() / "whole.png", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  const auto cut = folder.Write("cut.png", bytes.substr(0, bytes.size() / 2));
  EXPECT_TRUE(LookAtPicture(cut).ok());
  const auto picture = ReadPicture(cut);
  ASSERT_FALSE(picture.ok());
  EXPECT_THAT(picture.error().Text(), HasSubstr("cut.png' is cut short or broken"));
}

}  // namespace
}  // namespace rodeira::terrain

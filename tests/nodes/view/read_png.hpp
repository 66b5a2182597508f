// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <filesystem>

#include "nodes/view/frame/picture.hpp"

namespace rodeira::nodes {

inline Image ReadPng(const std::filesystem::path& path) {
  Image image;
  png_image header;
  std::memset(&header, 0, sizeof(header));
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&header, path.c_str()), 0) << path << ": " << header.message;
  header.format = PNG_FORMAT_RGB;
  image.width_px = static_cast<int>(header.width);
  image.height_px = static_cast<int>(header.height);
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr), 0) << path << ": " << header.message;
  return image;
}

}  // namespace rodeira::nodes

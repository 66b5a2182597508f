// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::window {

// Pixels from the top row on, three bytes each (red, green, blue).
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;

  // The three bytes of a pixel; y counts from the top. Precondition: within the picture.
  const std::uint8_t* At(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x))];
  }
  bool operator==(const Image&) const = default;
};

// Writes a PNG file: whole or not at all.
base::Status WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace rodeira::window

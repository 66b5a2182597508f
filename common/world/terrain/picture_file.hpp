// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

// Pictures that lie on the ground.
namespace rodeira::terrain {

// How a picture lies, seen from above, its upper edge in the north: its lower left corner and its size on the ground.
// It repeats in both directions from there, or is there once.
struct LaidPicture {
  std::string file;
  double west_m = 0.0, south_m = 0.0;
  double width_m = 1.0, height_m = 1.0;
  bool repeats = true;

  bool operator==(const LaidPicture&) const = default;
};

// Where a picture lies by a world file beside it (.jgw, .pgw …) or by its own georeference: the edges, in its map's
// unit.
struct PicturePlace {
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0;
};

// What is known of a picture without its pixels.
struct PictureFacts {
  int width_px = 0, height_px = 0;
  std::optional<PicturePlace> place;  // none where it is not said, or it is turned
};

// A picture's pixels, three bytes each: red, green, blue.
struct PictureFile {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgb;  // rows from the top
};

// No picture is wider or higher.
inline constexpr int kMaxPicture_px = 16'384;

// Both read JPEG, PNG, BMP and TIFF by GDAL; transparency is not looked at. Wrong input where there is no such file
// (the nearest name beside it is told), or it is no such picture, or a larger one.
base::Result<PictureFacts> LookAtPicture(const std::filesystem::path& path);
base::Result<PictureFile> ReadPicture(const std::filesystem::path& path);

}  // namespace rodeira::terrain

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.hpp"

namespace rodeira::editor {

// Pixels from the top row on, red, green, blue.
struct Pixels {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
};

constexpr int kLargestPicture_px = 16384;  // each way

// The bytes of a picture for a map: those of a PNG or JPEG file as they are, of a BMP or TIFF file a PNG of the same pixels, since the
// original program reads nothing else. Wrong input where it is no picture of these, is broken, or too large.
base::Result<std::string> ImportPicture(const std::filesystem::path& path);

// `progress(share)` is told from 0 to 1 and may say false: then there is no picture, and that is the error.
using Progress = std::function<bool(double)>;
base::Result<Pixels> DecodePicture(std::string_view bytes, const Progress& progress = {});

// A picture in levels: the first as it is, each further one half as large (means of four), the last at most one tile.
class Pyramid {
 public:
  static constexpr int kTile_px = 512;

  explicit Pyramid(Pixels pixels);

  int width_px() const { return levels_.front().width_px; }
  int height_px() const { return levels_.front().height_px; }
  const Pixels& level(std::size_t number) const { return levels_[number]; }
  std::size_t levels() const { return levels_.size(); }
  // The coarsest level whose pixels are no larger on the screen than a screen's pixel; one of the picture is `pixel_px` wide there.
  std::size_t LevelFor(double pixel_px) const;

 private:
  std::vector<Pixels> levels_;
};

}  // namespace rodeira::editor

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rodeira::editor {

// Pixels from the top row on, red, green, blue.
struct Pixels {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;
};

// A picture in levels: the first as it is, each further one half as large (means of four), the last at most one tile. A
// preview lacks the first ones.
class Pyramid {
 public:
  static constexpr int kTile_px = 512;

  explicit Pyramid(Pixels pixels);
  // Of a picture so large, of which `pixels` is the level `first`; that must be as large as SizeAt says.
  Pyramid(int width_px, int height_px, std::size_t first, Pixels pixels);

  int width_px() const { return width_px_; }  // of the picture as it is
  int height_px() const { return height_px_; }
  // From first() on.
  const Pixels& level(std::size_t number) const { return levels_[number - first_]; }
  std::size_t first() const { return first_; }
  std::size_t levels() const { return first_ + levels_.size(); }
  // The coarsest level with pixels no larger on the screen than a screen's pixel, or the finest there is; one of
  // the picture is `pixel_px` wide there.
  std::size_t LevelFor(double pixel_px) const;
  // Pixels of a side of so many, at a level.
  static int SizeAt(int size_px, std::size_t level) {
    return static_cast<int>((static_cast<std::size_t>(size_px) + (std::size_t{1} << level) - 1) >> level);
  }

 private:
  friend class PyramidBuilder;
  Pyramid() = default;

  int width_px_ = 0, height_px_ = 0;
  std::size_t first_ = 0;
  std::vector<Pixels> levels_;
};

// Makes a pyramid while its finest level is being filled from the top.
class PyramidBuilder {
 public:
  PyramidBuilder(int width_px, int height_px);
  explicit PyramidBuilder(Pixels finest);  // filled already

  Pixels& finest() { return pyramid_.levels_.front(); }
  // So many of its rows are final: all that follows from them is worked out.
  void Grow(int rows);
  // All rows must be.
  Pyramid Finish() && { return std::move(pyramid_); }

 private:
  void MakeRoom();

  Pyramid pyramid_;
  std::vector<int> done_;  // rows of each level
};

}  // namespace rodeira::editor

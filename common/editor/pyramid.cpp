// SPDX-License-Identifier: Apache-2.0
#include "common/editor/pyramid.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::editor {
namespace {

// Rows of the coarse level from those of the fine one: each pixel the mean of four, at odd edges of the two or one that
// there are.
void Halve(const Pixels& fine, Pixels& coarse, int from, int to) {
  const std::size_t fine_row = 3 * static_cast<std::size_t>(fine.width_px),
                    coarse_row = 3 * static_cast<std::size_t>(coarse.width_px);
  std::vector<std::uint16_t> sums(fine_row + 3);  // of two rows; the last pixel twice
  for (int y = from; y < to; ++y) {
    const std::uint8_t* upper = &fine.rgb[static_cast<std::size_t>(2 * y) * fine_row];
    const std::uint8_t* lower = 2 * y + 1 < fine.height_px ? upper + fine_row : upper;
    for (std::size_t i = 0; i < fine_row; ++i) sums[i] = static_cast<std::uint16_t>(upper[i] + lower[i]);
    for (std::size_t c = 0; c < 3; ++c) sums[fine_row + c] = sums[fine_row - 3 + c];
    std::uint8_t* out = &coarse.rgb[static_cast<std::size_t>(y) * coarse_row];
    for (std::size_t x = 0; x < static_cast<std::size_t>(coarse.width_px); ++x) {
      for (std::size_t c = 0; c < 3; ++c)
        out[3 * x + c] = static_cast<std::uint8_t>((sums[6 * x + c] + sums[6 * x + 3 + c] + 2) / 4);
    }
  }
}

Pixels Empty(int width_px, int height_px) {
  return {width_px, height_px,
          std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px))};
}

}  // namespace

Pyramid::Pyramid(Pixels pixels) {
  const int rows = pixels.height_px;
  PyramidBuilder builder(std::move(pixels));
  builder.Grow(rows);
  *this = std::move(builder).Finish();
}

Pyramid::Pyramid(int width_px, int height_px, std::size_t first, Pixels pixels) : Pyramid(std::move(pixels)) {
  RODEIRA_ASSERT(width_px_ == SizeAt(width_px, first) && height_px_ == SizeAt(height_px, first));
  width_px_ = width_px;
  height_px_ = height_px;
  first_ = first;
}

std::size_t Pyramid::LevelFor(double pixel_px) const {
  std::size_t level = 0;
  while (level + 1 < levels() && pixel_px * static_cast<double>(2u << level) <= 1.0) ++level;
  return std::max(level, first_);
}

PyramidBuilder::PyramidBuilder(int width_px, int height_px) : PyramidBuilder(Empty(width_px, height_px)) {}

PyramidBuilder::PyramidBuilder(Pixels finest) {
  pyramid_.width_px_ = finest.width_px;
  pyramid_.height_px_ = finest.height_px;
  pyramid_.levels_.push_back(std::move(finest));
  MakeRoom();
}

void PyramidBuilder::MakeRoom() {
  auto& levels = pyramid_.levels_;
  while (std::max(levels.back().width_px, levels.back().height_px) > Pyramid::kTile_px)
    levels.push_back(Empty((levels.back().width_px + 1) / 2, (levels.back().height_px + 1) / 2));
  done_.assign(levels.size(), 0);
}

void PyramidBuilder::Grow(int rows) {
  done_[0] = rows;
  for (std::size_t i = 1; i < done_.size(); ++i) {
    const Pixels& fine = pyramid_.levels_[i - 1];
    Pixels& coarse = pyramid_.levels_[i];
    const int to = done_[i - 1] == fine.height_px ? coarse.height_px : done_[i - 1] / 2;
    Halve(fine, coarse, done_[i], to);
    done_[i] = to;
  }
}

}  // namespace rodeira::editor

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>

#include "common/editor/background.hpp"
#include "common/editor/viewport.hpp"

namespace rodeira::nodes {

// Draws the background by tiles of the level that fits the screen. Tiles become textures as they are needed, some a
// picture, so that no picture waits long; until then the coarsest level is seen.
class PicturePainter {
 public:
  PicturePainter() = default;
  ~PicturePainter() { Clear(); }
  PicturePainter(const PicturePainter&) = delete;
  PicturePainter& operator=(const PicturePainter&) = delete;

  // `height_m` tall, its middle at the origin of W.
  void Draw(const std::shared_ptr<const editor::Pyramid>& picture, double height_m, const editor::Viewport& view,
            int left_px, int below_px);
  // Tiles that are seen are not all there yet: draw again.
  bool incomplete() const { return incomplete_; }

 private:
  struct Key {
    std::size_t level;
    int column, row;
    auto operator<=>(const Key&) const = default;
  };
  struct Tile {
    unsigned texture = 0;
    std::uint64_t used = 0;  // the picture in which it was seen last
  };
  void DrawLevel(std::size_t level, double metres_per_px, const editor::Viewport& view, bool all_at_once);
  const Tile* TileOf(const Key& key, bool make);
  void Clear();

  std::shared_ptr<const editor::Pyramid> picture_;
  std::map<Key, Tile> tiles_;
  std::uint64_t frame_ = 0;
  int made_ = 0;  // in this picture
  bool incomplete_ = false;
};

}  // namespace rodeira::nodes

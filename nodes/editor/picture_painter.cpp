// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/picture_painter.hpp"

#include <SDL_opengl.h>

#include <algorithm>
#include <cmath>

namespace rodeira::nodes {
namespace {

constexpr int kMaxMade = 4;             // a picture
constexpr std::size_t kMaxTiles = 160;  // of some 1 MB

}  // namespace

void PicturePainter::Clear() {
  for (const auto& [key, tile] : tiles_) glDeleteTextures(1, &tile.texture);
  tiles_.clear();
}

const PicturePainter::Tile* PicturePainter::TileOf(const Key& key, bool make) {
  auto found = tiles_.find(key);
  if (found == tiles_.end()) {
    if (!make) return nullptr;
    ++made_;
    const editor::Pixels& level = picture_->level(key.level);
    constexpr int kTile = editor::Pyramid::kTile_px;
    const int width = std::min(kTile, level.width_px - key.column * kTile),
              height = std::min(kTile, level.height_px - key.row * kTile);
    Tile tile;
    glGenTextures(1, &tile.texture);
    glBindTexture(GL_TEXTURE_2D, tile.texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, level.width_px);
    glPixelStorei(GL_UNPACK_SKIP_PIXELS, key.column * kTile);
    glPixelStorei(GL_UNPACK_SKIP_ROWS, key.row * kTile);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, level.rgb.data());
    for (const GLenum what : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS}) glPixelStorei(what, 0);
    found = tiles_.emplace(key, tile).first;
  }
  found->second.used = frame_;
  return &found->second;
}

void PicturePainter::DrawLevel(std::size_t number, double metres_per_px, const editor::Viewport& view,
                               bool all_at_once) {
  constexpr int kTile = editor::Pyramid::kTile_px;
  const editor::Pixels& level = picture_->level(number);
  // Pixels of this level; its last column and row may reach beyond the picture by a part of one.
  const double pixel_m = metres_per_px * static_cast<double>(1u << number);
  const double west_m = -0.5 * picture_->width_px() * metres_per_px,
               north_m = 0.5 * picture_->height_px() * metres_per_px;
  const Eigen::Vector2d seen_low = view.ToWorld({0.0, view.height_px}), seen_high = view.ToWorld({view.width_px, 0.0});
  const auto tile_of = [&](double m, int count_px) {
    return static_cast<int>(
        std::clamp(std::floor(m / pixel_m / kTile), -1.0, std::ceil(static_cast<double>(count_px) / kTile)));
  };
  const int columns = (level.width_px + kTile - 1) / kTile, rows = (level.height_px + kTile - 1) / kTile;
  for (int row = std::max(0, tile_of(north_m - seen_high.y(), level.height_px));
       row <= std::min(rows - 1, tile_of(north_m - seen_low.y(), level.height_px)); ++row) {
    for (int column = std::max(0, tile_of(seen_low.x() - west_m, level.width_px));
         column <= std::min(columns - 1, tile_of(seen_high.x() - west_m, level.width_px)); ++column) {
      const Tile* tile = TileOf({number, column, row}, all_at_once || made_ < kMaxMade);
      if (tile == nullptr) {
        incomplete_ = true;
        continue;
      }
      const double left = west_m + column * kTile * pixel_m,
                   right = west_m + std::min((column + 1) * kTile, level.width_px) * pixel_m;
      const double top = north_m - row * kTile * pixel_m,
                   bottom = north_m - std::min((row + 1) * kTile, level.height_px) * pixel_m;
      const auto corner = [&](double u, double v, double x, double y) {
        glTexCoord2d(u, v);
        glVertex2d(x - view.middle_W.x(), y - view.middle_W.y());
      };
      glBindTexture(GL_TEXTURE_2D, tile->texture);
      glBegin(GL_QUADS);
      corner(0.0, 0.0, left, top), corner(1.0, 0.0, right, top), corner(1.0, 1.0, right, bottom),
          corner(0.0, 1.0, left, bottom);
      glEnd();
    }
  }
}

void PicturePainter::Draw(const std::shared_ptr<const editor::Pyramid>& picture, double height_m,
                          const editor::Viewport& view, int left_px, int below_px) {
  incomplete_ = false;
  if (picture != picture_) Clear();
  picture_ = picture;
  if (picture == nullptr) return;
  ++frame_;
  made_ = 0;
  glViewport(left_px, below_px, static_cast<int>(view.width_px), static_cast<int>(view.height_px));
  glMatrixMode(GL_PROJECTION);
  glLoadIdentity();
  const double half_x = 0.5 * view.width_m(), half_y = 0.5 * view.height_px * view.metres_per_px;
  glOrtho(-half_x, half_x, -half_y, half_y, -1.0, 1.0);
  glMatrixMode(GL_MODELVIEW);
  glLoadIdentity();
  glDisable(GL_BLEND);
  glEnable(GL_TEXTURE_2D);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  const double metres_per_px = height_m / picture->height_px();
  const std::size_t fitting = picture->LevelFor(metres_per_px / view.metres_per_px), coarsest = picture->levels() - 1;
  DrawLevel(fitting, metres_per_px, view, fitting == coarsest);
  if (incomplete_) {
    DrawLevel(coarsest, metres_per_px, view, true);
    DrawLevel(fitting, metres_per_px, view, false);
  }
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
  glDisable(GL_TEXTURE_2D);
  while (tiles_.size() > kMaxTiles) {
    const auto oldest = std::min_element(tiles_.begin(), tiles_.end(),
                                         [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    if (oldest->second.used == frame_) break;
    glDeleteTextures(1, &oldest->second.texture);
    tiles_.erase(oldest);
  }
}

}  // namespace rodeira::nodes

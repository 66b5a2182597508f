// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/window/loading.hpp"

#include <SDL.h>
#include <SDL_opengl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/runtime/launch/live_keys.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kBarShare = 0.6;
constexpr int kBarHeight_px = 14;
constexpr double kPieceShare = 0.2;

void Fill(int x_px, int y_px, int width_px, int height_px, float grey) {
  glScissor(x_px, y_px, width_px, height_px);
  glClearColor(grey, grey, grey, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
}

// The bar from one share of its length to another.
void DrawBar(int width_px, int height_px, double from, double to) {
  const int width = static_cast<int>(std::lround(kBarShare * width_px)), x = (width_px - width) / 2,
            y = (height_px - kBarHeight_px) / 2;
  const auto px = [width](double share) { return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * width)); };
  glEnable(GL_SCISSOR_TEST);
  Fill(0, 0, width_px, height_px, 0.10F);
  Fill(x, y, width, kBarHeight_px, 0.25F);
  Fill(x + px(from), y, px(to) - px(from), kBarHeight_px, 0.80F);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);  // as a context begins
}

}  // namespace

std::string LoadingTitle(const std::string& title, double share, const std::string& what) {
  return fmt::format("{}, {:.0f} %: {}", title, 100.0 * std::clamp(share, 0.0, 1.0), what);
}

std::string WorkTitle(const std::string& title, double seconds, const std::string& what) {
  return fmt::format("{}, {:.0f} s: {}", title, std::floor(seconds), what);
}

void DrawLoadingBar(int width_px, int height_px, double share) { DrawBar(width_px, height_px, 0.0, share); }

void DrawWorkBar(int width_px, int height_px, double seconds) {
  const double way = std::fabs(std::remainder(seconds, 2.0));  // 0 to 1 and back
  DrawBar(width_px, height_px, (1.0 - kPieceShare) * way, (1.0 - kPieceShare) * way + kPieceShare);
}

void Loading::Show(double share, const std::string& what) {
  if (surface_.kind() != SurfaceKind::kWindow) return;
  SDL_PumpEvents();  // a window that never asks is called dead
  const double now_s = launch::WallSeconds();
  if (what == what_ && now_s - shown_wall_s_ < kAgain_s) return;
  what_ = what;
  shown_wall_s_ = now_s;
  SDL_SetWindowTitle(SDL_GL_GetCurrentWindow(), LoadingTitle(title_, share, what).c_str());
  DrawLoadingBar(surface_.width_px(), surface_.height_px(), share);
  surface_.Swap();
}

void Loading::ShowWork(double seconds, const std::string& what) {
  if (surface_.kind() != SurfaceKind::kWindow) return;
  SDL_PumpEvents();
  SDL_SetWindowTitle(SDL_GL_GetCurrentWindow(), WorkTitle(title_, seconds, what).c_str());
  DrawWorkBar(surface_.width_px(), surface_.height_px(), seconds);
  surface_.Swap();
}

void Loading::End(const std::string& title) { SDL_SetWindowTitle(SDL_GL_GetCurrentWindow(), title.c_str()); }

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/window/reading.hpp"

#include <chrono>
#include <future>

#include "common/runtime/launch/live_keys.hpp"
#include "nodes/view/window/loading.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kTitle = "Rodeira";  // the world has no name yet
constexpr std::chrono::milliseconds kAgain(40);

}  // namespace

base::Result<std::unique_ptr<Surface>> OpenSurface(SurfaceKind kind, const ViewSettings& settings, bool resizable) {
  auto surface =
      Surface::Open(kind, settings.width_px, settings.height_px, kTitle, resizable, settings.display, settings.quality);
  if (surface && settings.full_screen) surface.value()->ToggleFullScreen();
  return surface;
}

base::Result<ReadWorld> ReadBefore(Surface* surface, const WorldReader& reader) {
  if (surface == nullptr || surface->kind() != SurfaceKind::kWindow) return reader();
  const double begin_s = launch::WallSeconds();
  auto read = std::async(std::launch::async, reader);
  Loading loading(*surface, kTitle);
  do loading.ShowWork(launch::WallSeconds() - begin_s, "the world is read");
  while (read.wait_for(kAgain) != std::future_status::ready);
  return read.get();
}

}  // namespace rodeira::nodes

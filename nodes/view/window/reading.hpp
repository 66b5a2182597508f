// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/surface.hpp"
#include "nodes/view/view_settings.hpp"

namespace rodeira::nodes {

// What a view is to show.
struct ReadWorld {
  std::shared_ptr<const road::World> world;
  std::filesystem::path built;  // the folder of its database; empty: there is none
};
// Reads it: takes as long as the world is large.
using WorldReader = std::function<base::Result<ReadWorld>()>;

// The surface that the settings ask for; of a window before anything is known of its world. Wrong input as
// Surface::Open.
base::Result<std::unique_ptr<Surface>> OpenSurface(SurfaceKind kind, const ViewSettings& settings, bool resizable);

// Reads while the window of this thread's surface lives and shows that its world is read; the reader is called once, on
// another thread where there is a window, and has ended when this returns. `surface`: null, or no window: only reads.
base::Result<ReadWorld> ReadBefore(Surface* surface, const WorldReader& reader);

}  // namespace rodeira::nodes

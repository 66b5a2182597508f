#pragma once

#include <memory>

#include "common/base/result.hpp"
#include "common/road/world.hpp"
#include "common/scene/world_scene.hpp"
#include "nodes/view/picture.hpp"
#include "nodes/view/surface.hpp"

namespace rodeira::view {

// Draws a world and what moves in it. Everything happens on the thread that made it, which is the surface's.
class Painter {
 public:
  // Both must outlive it.
  Painter(Surface& surface, const road::World& world, const scene::WorldScene& standing);
  ~Painter();

  // Draws; nothing is shown yet.
  void Draw(const Picture& picture);
  // What was drawn last, from before any Surface::Swap.
  Image Read() const;

 private:
  struct Parts;
  Surface& surface_;
  const road::World& world_;
  std::unique_ptr<Parts> parts_;
};

// Whether every model that a world names can be read. Wrong input otherwise.
base::Status CheckModels(const scene::WorldScene& standing);

// One picture of a world, without a window and without a run.
base::Result<Image> RenderStill(const road::World& world, const Picture& picture, int width_px, int height_px);

}  // namespace rodeira::view

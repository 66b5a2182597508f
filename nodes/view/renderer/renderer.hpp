// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/view/scene/visual_world/world_scene.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/frame/picture_target.hpp"
#include "nodes/view/frame/surface.hpp"

namespace rodeira::nodes {

struct PagedWorld;

// What the last picture asked of the renderer, mirrors and shadow map included.
struct PictureCost {
  std::size_t calls = 0;      // of drawing
  std::size_t triangles = 0;  // of a model at many places its own, once
};

// Draws a world and what moves in it. Everything happens on the thread that made it, which is the surface's.
class Renderer {
 public:
  // Both must outlive it. `repeats`: what is repeated is drawn as one model at many places, where quality and OpenGL
  // say so too; otherwise merged.
  Renderer(Surface& surface, const road::World& world, const scene::WorldScene& standing, bool repeats = true);
  // With the ground of a built database (FindBuilt). A failure where OpenSceneGraph cannot read it.
  static base::Result<std::unique_ptr<Renderer>> Make(Surface& surface, const road::World& world,
                                                      const std::filesystem::path& built, bool repeats = true);
  // With ground that is made where the eye comes near (BuildVisualWorld says which models are meant), of a world that
  // has a network.
  static std::unique_ptr<Renderer> Make(Surface& surface, const road::World& world, scene::ModelIsThere is_there,
                                        bool repeats = true);
  ~Renderer();

  // Shows a model from a file for driven cars (CarNode::UseModel says what is expected). Wrong input where it cannot be
  // read: nothing is changed.
  base::Status UseCarModel(const std::filesystem::path& file);
  // Draws; nothing is shown yet. Of ground that is read or made as the eye comes near, what is there so far; the rest
  // is asked for. At low quality, of pictures that follow one another, one mirror each.
  void Draw(const Picture& picture);
  // The same into other pixels than the surface's, every mirror.
  void DrawInto(const Picture& picture, const PictureTarget& target);
  // Draws, and waits for all that is to be seen: a pure function of the world and the picture, built or not. `progress`
  // is told how far it is while it waits.
  void DrawWhole(const Picture& picture, const scene::Progress& progress = {});
  // From where such a picture is seen.
  scene::Camera CameraOf(const Picture& picture) const;
  // Of the picture that was drawn last.
  PictureCost CostOfLast() const;
  // How many levels of tiles are in memory, of ground that is read or made as the eye comes near; 0 where all of it is
  // there from the beginning.
  std::size_t HeldLevels() const;
  // What was drawn last, from before any Surface::Swap.
  Image Read() const;

 private:
  struct Parts;
  Renderer(Surface& surface, const road::World& world, bool repeats);
  void Lay(PagedWorld paged);
  void SetUp();
  void DrawOnce(const Picture& picture, const PictureTarget& target, bool whole);  // `whole`: every mirror
  // Requests the ground that such a picture shows. Draws its pixels too where OpenGL cannot leave them out, and says
  // so.
  bool RequestVisible(const Picture& picture, const PictureTarget& target);
  Surface& surface_;
  const road::World& world_;
  std::unique_ptr<Parts> parts_;
};

// A renderer of the world with the ground of a built database, or, where `built` is empty, with ground that is made in
// memory, of a network where the eye comes near: what has a model that cannot be read is then drawn without it, which
// is said once on the standard error. `progress` is told of what is made before it returns.
base::Result<std::unique_ptr<Renderer>> RendererOf(Surface& surface, const road::World& world,
                                                   const std::filesystem::path& built, bool repeats = true,
                                                   const scene::Progress& progress = {});

// One picture of a world, without a window and without a run.
// `built`: the folder of a database with the ground that is shown; empty: the ground is made in memory.
base::Result<Image> RenderStill(const road::World& world, const Picture& picture, int width_px, int height_px,
                                const std::filesystem::path& built = {}, Quality quality = Quality::kMedium);

}  // namespace rodeira::nodes

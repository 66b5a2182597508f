// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/view/scene/playback/player.hpp"
#include "nodes/view/window/reading.hpp"
#include "nodes/view/window/view_window.hpp"

union SDL_Event;

namespace rodeira::nodes {

struct TimelinePlace;

enum class MarkKind { kRemark, kEvent };  // of the operator, the clock or a fault; of a scenario

// Something to be found again on the bar.
struct ReplayMark {
  std::int64_t time_ns = 0;
  std::string text;
  MarkKind kind = MarkKind::kRemark;
};

// A window in which a person goes through a recording. It knows no files: where the moments come from it is told.
// Made and used on one thread.
class ReplayWindow {
 public:
  using MomentAt = std::function<base::Result<scene::SceneSnapshot>(std::int64_t time_ns)>;
  using TakeMarks = std::function<std::optional<base::Result<std::vector<ReplayMark>>>()>;

  // It is there before its world is read; what is wrong there is the answer. Wrong input where a display or OpenGL is
  // missing. `kind`: off-screen for tests.
  static base::Result<std::unique_ptr<ReplayWindow>> Open(const ViewSettings& settings, const WorldReader& reader,
                                                          SurfaceKind kind = SurfaceKind::kWindow);

  // Until the person closes the window, or `stop` (asked between two pictures) says so. Where `moment_at` has an error
  // the player stands still, the picture stays and the bar says why; one can go elsewhere. The first such error is the
  // answer. `take_marks` is asked between two pictures; what it gives, ascending, is on the bar from then on, in the
  // place of what it gave before. Marks that cannot be read are the answer as well, and are not on the bar.
  base::Status Watch(scene::Player& player, const TakeMarks& take_marks, const MomentAt& moment_at,
                     const std::function<bool()>& stop);

 private:
  ReplayWindow(std::shared_ptr<const road::World> world, std::unique_ptr<ViewWindow> screen)
      : world_(std::move(world)), screen_(std::move(screen)) {}
  bool ReadEvents(scene::Player& player, const std::vector<std::int64_t>& marks_ns);
  void Take(const SDL_Event& event, scene::Player& player, const std::vector<std::int64_t>& marks_ns);
  TimelinePlace Bar() const;
  void Drag(int x_px, scene::Player& player);

  std::shared_ptr<const road::World> world_;
  std::unique_ptr<ViewWindow> screen_;  // on it
  scene::SceneSnapshot shown_;
  scene::PicturePace pace_;
  bool open_ = true;
  bool drags_ = false;  // the mouse holds the bar
};

// What the bar shows of a player: "0:05.42 / 1:30.00   x -2  paused" (backward), and the mark within a second.
Timeline TimelineOf(const scene::Player& player, const std::vector<ReplayMark>& marks);

}  // namespace rodeira::nodes

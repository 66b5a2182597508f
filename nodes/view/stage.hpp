#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "common/base/result.hpp"
#include "common/road/world.hpp"
#include "common/scene/display_clock.hpp"
#include "common/scene/moment.hpp"
#include "nodes/view/picture.hpp"
#include "nodes/view/view_settings.hpp"

namespace rodeira::view {

// The thread that draws. OpenGL and the window live there and nowhere else; the run's thread only hands over moments, and
// waits only for pictures that it asked for.
class Stage {
 public:
  // Starts the thread and waits until everything is loaded and drawn once. Null where the settings want no picture here:
  // no frames, and no window or no display for one. Wrong input where a display or OpenGL is missing.
  static base::Result<std::unique_ptr<Stage>> Open(const ViewSettings& settings, std::shared_ptr<const road::World> world);
  ~Stage();

  // Whether there is a window, now.
  bool has_window() const;
  // What the window shows next. Never waits for the drawing.
  void Show(scene::Moment moment);
  // Exactly this picture, drawn now.
  Image Draw(const Picture& picture);

 private:
  struct Hand;  // what only the thread touches
  Stage(const ViewSettings& settings, std::shared_ptr<const road::World> world);
  void Run();
  base::Status SetUp(Hand& hand);
  void Loop(Hand& hand);
  void ServeRequest(Hand& hand, std::unique_lock<std::mutex>& lock);
  void ShowWindow(Hand& hand, std::unique_lock<std::mutex>& lock);
  bool ReadKeys(Hand& hand);

  const ViewSettings settings_;
  const std::shared_ptr<const road::World> world_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool ready_ = false;
  base::Status set_up_;
  bool quit_ = false;
  bool window_ = false;
  bool nothing_to_draw_ = false;
  scene::PoseHistory history_;
  scene::DisplayClock clock_;
  const Picture* request_ = nullptr;
  std::optional<Image> answer_;
  std::thread thread_;  // last: it starts when all else is there
};

}  // namespace rodeira::view

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/live_keys.hpp"
#include "common/runtime/launch/live_requests.hpp"
#include "common/view/scene/playback/display_clock.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/view_settings.hpp"
#include "nodes/view/window/reading.hpp"

namespace rodeira::nodes {

// The thread that draws. OpenGL and the window live there and nowhere else. The run's thread only hands over values:
// what is drawn depends on them alone, not on when.
class RenderThread {
 public:
  // Starts the thread and waits until everything is loaded and drawn once; a window is there before its world is read.
  // Without settings.waits_for_picture it waits for the surface and the world only, and what fails later is status().
  // Null where the settings want no picture here: no frames, and no window or no display for one. Wrong input where a
  // display or OpenGL is missing. `keys` is told what is held in the window; null where it drives nothing.
  // `requests`: what is asked for there; null where no node takes any. `reader`: what is wrong there is the answer;
  // called on a thread of its own, it has ended when this returns, and is not called where a window that must be cannot
  // be.
  static base::Result<std::unique_ptr<RenderThread>> Open(
      const ViewSettings& settings, WorldReader reader, std::unique_ptr<launch::LiveKeysSender> keys = nullptr,
      std::unique_ptr<launch::LiveRequestsSender> requests = nullptr);
  // Of a world that is read already.
  static base::Result<std::unique_ptr<RenderThread>> Open(const ViewSettings& settings,
                                                          std::shared_ptr<const road::World> world);
  ~RenderThread();

  // Whether there is a window, now.
  bool has_window() const;
  // What the window shows next. Never waits for the drawing.
  void Show(scene::SceneSnapshot moment);
  // What the run's scenario has said. Never waits.
  void Tell(const std::vector<scenario::Event>& events);
  // The first thing that failed while pictures were prepared or written.
  base::Status status() const;
  // Orders exactly this picture as a PNG file. Waits while many orders are not written. The answer is status().
  base::Status Order(Picture picture, std::filesystem::path file);
  // Waits until all orders are written.
  base::Status Drain();

 private:
  struct State;  // what only the thread touches
  struct Ordered {
    Picture picture;
    std::filesystem::path file;
  };
  RenderThread(const ViewSettings& settings, WorldReader reader, std::unique_ptr<launch::LiveKeysSender> keys,
               std::unique_ptr<launch::LiveRequestsSender> requests);
  void Run();
  // The surface, null where there is nothing to draw here, and the world.
  base::Status ReadFirst(std::unique_ptr<Surface>& surface, std::filesystem::path& built);
  base::Status SetUp(State& state, std::unique_ptr<Surface> surface, std::filesystem::path built);
  // What Open or, if that has returned, status() says.
  void Answer(base::Status status, const State& state, bool draws);
  base::Status OpenSurfaceFor(std::unique_ptr<Surface>& surface) const;
  void Loop(State& state);
  void ServeOrder(State& state, std::unique_lock<std::mutex>& lock);
  void ShowWindow(State& state, std::unique_lock<std::mutex>& lock);
  bool ReadKeys(State& state);

  const ViewSettings settings_;
  const WorldReader reader_;
  std::shared_ptr<const road::World> world_;              // the thread's, once it is read
  std::unique_ptr<launch::LiveKeysSender> keys_;          // until the thread takes it
  std::unique_ptr<launch::LiveRequestsSender> requests_;  // likewise

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool surface_open_ = false;
  bool ready_ = false;
  base::Status set_up_;
  bool quit_ = false;
  bool window_ = false;
  bool nothing_to_draw_ = false;
  scene::PoseHistory history_;
  scene::DisplayClock clock_;
  std::vector<scenario::Event> told_;  // by the run, not yet seen by the window
  std::deque<Ordered> orders_;         // the first is being drawn
  base::Status written_;
  std::thread thread_;  // last: it starts when all else is there
};

}  // namespace rodeira::nodes

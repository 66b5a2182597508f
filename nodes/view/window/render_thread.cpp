// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/window/render_thread.hpp"

#include <SDL.h>

#include <chrono>
#include <string_view>
#include <utility>

#include "common/core/base/exhaustion.hpp"
#include "common/core/base/wait.hpp"
#include "nodes/view/frame/png.hpp"
#include "nodes/view/run_connection/key_forwarder.hpp"
#include "nodes/view/run_connection/live_requester.hpp"
#include "nodes/view/window/view_window.hpp"

namespace rodeira::nodes {
namespace {

constexpr std::size_t kMaxOrders = 32;
// Mesa's llvmpipe waits for ever for its threads where it cannot start one. Else a context takes seconds at most.
constexpr std::chrono::seconds kSurfaceLimit{60};
constexpr std::string_view kNoSurfaceText =
    "OpenGL is not open after 60 s: a driver that gets no thread or memory waits for ever (ulimit -u, the container's "
    "limits)";

}  // namespace

struct RenderThread::State {
  std::unique_ptr<ViewWindow> screen;
  std::unique_ptr<KeyForwarder> keys;             // null: the window drives nothing
  std::unique_ptr<LiveRequester> live_requester;  // null: no node takes requests
  std::unique_ptr<WheelButtons> wheel;            // null: it has no buttons for the window
  scene::PicturePace pace;
};

RenderThread::RenderThread(const ViewSettings& settings, WorldReader reader,
                           std::unique_ptr<launch::LiveKeysSender> keys,
                           std::unique_ptr<launch::LiveRequestsSender> requests)
    : settings_(settings), reader_(std::move(reader)), keys_(std::move(keys)), requests_(std::move(requests)) {
  thread_ = std::thread([this] { Run(); });
}

base::Result<std::unique_ptr<RenderThread>> RenderThread::Open(const ViewSettings& settings,
                                                               std::shared_ptr<const road::World> world) {
  return Open(settings, [shown = ReadWorld{std::move(world), settings.built}] { return shown; });
}

base::Result<std::unique_ptr<RenderThread>> RenderThread::Open(const ViewSettings& settings, WorldReader reader,
                                                               std::unique_ptr<launch::LiveKeysSender> keys,
                                                               std::unique_ptr<launch::LiveRequestsSender> requests) {
  std::unique_ptr<RenderThread> render_thread(
      new RenderThread(settings, std::move(reader), std::move(keys), std::move(requests)));
  {
    const base::WaitNote note("the view's window and its world");
    std::unique_lock lock(render_thread->mutex_);
    const auto is_ready = [&] { return render_thread->ready_; };
    if (!render_thread->changed_.wait_for(lock, kSurfaceLimit, is_ready) && !render_thread->surface_open_)
      base::EndExhausted(kNoSurfaceText);
    render_thread->changed_.wait(lock, is_ready);
    if (!render_thread->set_up_) return render_thread->set_up_.error();
    if (!render_thread->nothing_to_draw_) return render_thread;
  }
  return std::unique_ptr<RenderThread>();
}

RenderThread::~RenderThread() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool RenderThread::has_window() const {
  const std::lock_guard lock(mutex_);
  return window_;
}

void RenderThread::Show(scene::SceneSnapshot moment) {
  const double wall_s = launch::WallSeconds();
  const std::lock_guard lock(mutex_);
  history_.Add(std::move(moment));
  clock_.Arrived(wall_s, static_cast<double>(history_.newest_ns()) * 1e-9,
                 static_cast<double>(history_.interval_ns()) * 1e-9);
}

void RenderThread::Tell(const std::vector<scenario::Event>& events) {
  const std::lock_guard lock(mutex_);
  told_.insert(told_.end(), events.begin(), events.end());
}

base::Status RenderThread::status() const {
  const std::lock_guard lock(mutex_);
  return written_;
}

base::Status RenderThread::Order(Picture picture, std::filesystem::path file) {
  const base::WaitNote note("pictures to be written");
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return orders_.size() < kMaxOrders || !written_; });
  if (!written_) return written_;
  orders_.push_back({std::move(picture), std::move(file)});
  changed_.notify_all();
  return {};
}

base::Status RenderThread::Drain() {
  const base::WaitNote note("pictures to be written");
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return orders_.empty() || !written_; });
  return written_;
}

void RenderThread::Run() {
  State state;
  std::unique_ptr<Surface> surface;
  std::filesystem::path built;
  base::Status status = ReadFirst(surface, built);
  const bool draws = status.ok() && surface != nullptr;
  if (draws) {
    if (!settings_.waits_for_picture) Answer({}, state, true);
    status = SetUp(state, std::move(surface), std::move(built));
  }
  const bool go_on = status.ok() && state.screen != nullptr;
  Answer(std::move(status), state, go_on);
  if (go_on) Loop(state);
}

void RenderThread::Answer(base::Status status, const State& state, bool draws) {
  {
    const std::lock_guard lock(mutex_);
    window_ = status.ok() && state.screen != nullptr &&
              (state.screen->surface().kind() == SurfaceKind::kWindow || state.screen->has_headset());
    if (!ready_) {
      nothing_to_draw_ = !draws;
      set_up_ = std::move(status);
      ready_ = true;
    } else if (!status) {
      written_ = std::move(status);
    }
  }
  changed_.notify_all();
}

// Null where there is nothing to draw here.
base::Status RenderThread::OpenSurfaceFor(std::unique_ptr<Surface>& surface) const {
  const bool only_window = settings_.frame_steps.empty() && !settings_.headset;
  const auto open = [&](SurfaceKind kind) -> base::Status {
    auto opened = OpenSurface(kind, settings_, settings_.frame_steps.empty());
    if (!opened) return opened.error();
    surface = std::move(opened).value();
    return {};
  };
  if (settings_.window == WindowMode::kAlways) return open(SurfaceKind::kWindow);
  if (settings_.window == WindowMode::kAuto && HasDisplay() && open(SurfaceKind::kWindow))
    return {};  // a display without OpenGL is as good as none
  return only_window ? base::Status() : open(SurfaceKind::kOffscreen);
}

base::Status RenderThread::ReadFirst(std::unique_ptr<Surface>& surface, std::filesystem::path& built) {
  if (auto status = OpenSurfaceFor(surface); !status) return status;
  {
    const std::lock_guard lock(mutex_);
    surface_open_ = true;
  }
  auto shown = ReadBefore(surface.get(), reader_);
  if (!shown) return shown.error();
  world_ = std::move(shown.value().world);
  built = std::move(shown.value().built);
  return {};
}

base::Status RenderThread::SetUp(State& state, std::unique_ptr<Surface> surface, std::filesystem::path built) {
  ViewSettings settings = settings_;
  settings.built = std::move(built);
  const std::string own = WindowHelp(settings_.mouse_button),
                    help = settings_.driving_help.empty() ? own : own + "\n\n" + settings_.driving_help;
  auto screen = ViewWindow::Open(std::move(surface), settings, *world_, help);
  if (!screen) return screen.error();
  state.screen = std::move(screen).value();
  if (state.screen->surface().kind() == SurfaceKind::kOffscreen && settings_.frame_steps.empty() &&
      !state.screen->has_headset()) {
    state.screen.reset();
    return {};
  }
  if (keys_ != nullptr) state.keys = std::make_unique<KeyForwarder>(std::move(keys_));
  if (state.screen->surface().kind() == SurfaceKind::kWindow)
    state.wheel = WheelButtons::Open(settings_.camera_buttons);
  if (requests_ != nullptr) {
    state.live_requester = std::make_unique<LiveRequester>(std::move(requests_));
    state.screen->set_ask([&live_requester = *state.live_requester](const scenario::Request& request) {
      return live_requester.Request(request);
    });
  }
  return {};
}

void RenderThread::Loop(State& state) {
  std::unique_lock lock(mutex_);
  while (!quit_) {
    if (!orders_.empty()) {
      ServeOrder(state, lock);
    } else if (window_ && !history_.empty()) {
      ShowWindow(state, lock);
    } else {
      changed_.wait_for(lock, std::chrono::milliseconds(window_ ? 10 : 1000),
                        [&] { return quit_ || !orders_.empty(); });
      if (window_) {
        lock.unlock();
        const bool open = ReadKeys(state);
        lock.lock();
        window_ = window_ && open;
      }
    }
    if (state.live_requester != nullptr) {
      const std::vector<scenario::Event> told = std::exchange(told_, {});
      lock.unlock();  // it writes to the bus, for which the run's thread must not wait
      state.live_requester->See(told);
      state.live_requester->Tell(launch::WallSeconds());
      lock.lock();
    }
  }
}

void RenderThread::ServeOrder(State& state, std::unique_lock<std::mutex>& lock) {
  const Ordered& order = orders_.front();  // others are only added behind it
  lock.unlock();
  state.screen->renderer().DrawWhole(order.picture);
  base::Status status = WritePng(order.file, state.screen->renderer().Read());
  lock.lock();
  if (written_) written_ = std::move(status);
  orders_.pop_front();
  changed_.notify_all();
}

void RenderThread::ShowWindow(State& state, std::unique_lock<std::mutex>& lock) {
  const double begin_s = launch::WallSeconds();
  const double rate = clock_.rate();
  lock.unlock();
  bool open = ReadKeys(state);
  const bool waited = state.screen->WaitForHeadset();
  lock.lock();
  scene::SceneSnapshot moment = history_.At(clock_.Now(waited ? launch::WallSeconds() : begin_s) * 1e9);
  lock.unlock();
  state.screen->Show(std::move(moment), rate);
  lock.lock();
  open = open && (state.screen->surface().kind() == SurfaceKind::kWindow || state.screen->has_headset());
  if (!open) window_ = false;
  if (waited) return;
  const double rest_s = state.pace.Next(begin_s, state.screen->surface().beat()) - launch::WallSeconds();
  if (rest_s > 0.0)
    changed_.wait_for(lock, std::chrono::duration<double>(rest_s), [&] { return quit_ || !orders_.empty(); });
}

// False where the person closed the window.
bool RenderThread::ReadKeys(State& state) {
  SDL_Event event;
  bool open = true;
  while (SDL_PollEvent(&event) != 0) {
    if (event.type == SDL_QUIT) open = false;
    if (event.type == SDL_KEYDOWN && event.key.repeat == 0 && event.key.keysym.sym == SDLK_ESCAPE) open = false;
    const bool own = event.type == SDL_KEYDOWN && event.key.repeat == 0 &&
                     (event.key.keysym.sym == SDLK_ESCAPE ||
                      state.screen->TakeKey(event.key.keysym.sym, state.keys != nullptr, event.key.keysym.mod));
    if (state.screen->TakeMouse(event)) continue;
    if (!own && state.keys != nullptr) state.keys->Take(event);
  }
  open = open && !state.screen->asked_to_close();
  if (state.wheel != nullptr && state.wheel->Pressed()) (void)state.screen->TakeKey(SDLK_k, true);
  if (state.keys != nullptr) {
    if (!open) state.keys->ReleaseAll();
    state.keys->Tell(launch::WallSeconds());
  }
  if (!open) state.screen->surface().Hide();
  return open;
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/playback/replay_window.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "common/runtime/launch/live_keys.hpp"
#include "nodes/view/overlays/timeline_bar.hpp"
#include "nodes/view/playback/replay_keys.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kLongestTick_s = 0.25;  // a machine that stalls slips; it does not leap
constexpr int kWait_ms = 20;             // between two looks whether to stop, while nothing moves
constexpr std::int64_t kNear_ns = 1'000'000'000;

// "1:02:03.45" of hours, minutes, seconds; without hours where there are none.
std::string TimeText(std::int64_t time_ns) {
  const std::int64_t hundredths = (time_ns + 5'000'000) / 10'000'000;  // rounded, as the instruments do
  const std::int64_t seconds = hundredths / 100, minutes = seconds / 60, hours = minutes / 60;
  const std::string rest = fmt::format("{:02}.{:02}", seconds % 60, hundredths % 100);
  return hours > 0 ? fmt::format("{}:{:02}:{}", hours, minutes % 60, rest) : fmt::format("{}:{}", minutes, rest);
}

}  // namespace

Timeline TimelineOf(const scene::Player& player, const std::vector<ReplayMark>& marks) {
  const auto share = [&](std::int64_t time_ns) {
    return player.end_ns() > 0
               ? std::clamp(static_cast<double>(time_ns) / static_cast<double>(player.end_ns()), 0.0, 1.0)
               : 0.0;
  };
  Timeline timeline;
  timeline.share = share(player.now_ns());
  timeline.where = fmt::format("{} / {}   x {:g}{}", TimeText(player.now_ns()), TimeText(player.end_ns()),
                               player.backward() ? -player.speed() : player.speed(), player.paused() ? "  paused" : "");
  timeline.keys = ReplayKeysInShort();
  std::int64_t nearest_ns = kNear_ns + 1;
  for (const ReplayMark& mark : marks) {
    (mark.kind == MarkKind::kEvent ? timeline.events : timeline.marks).push_back(share(mark.time_ns));
    const std::int64_t away_ns = std::abs(mark.time_ns - player.now_ns());
    if (away_ns >= nearest_ns) continue;
    nearest_ns = away_ns;
    timeline.note = mark.text;
  }
  return timeline;
}

base::Result<std::unique_ptr<ReplayWindow>> ReplayWindow::Open(const ViewSettings& settings, const WorldReader& reader,
                                                               SurfaceKind kind) {
  auto surface = OpenSurface(kind, settings, true);
  if (!surface) return surface.error();
  auto read = ReadBefore(surface.value().get(), reader);
  if (!read) return read.error();
  ViewSettings watched = settings;
  watched.built = std::move(read.value().built);
  watched.mouse_button = kLeftButton;  // no window drives any more
  std::shared_ptr<const road::World> world = std::move(read.value().world);
  auto screen = ViewWindow::Open(std::move(surface).value(), watched, *world, ReplayHelp());
  if (!screen) return screen.error();
  return std::unique_ptr<ReplayWindow>(new ReplayWindow(std::move(world), std::move(screen).value()));
}

base::Status ReplayWindow::Watch(scene::Player& player, const TakeMarks& take_marks, const MomentAt& moment_at,
                                 const std::function<bool()>& stop) {
  std::vector<ReplayMark> marks;
  std::vector<std::int64_t> marks_ns;
  base::Status problem;
  double looked_s = launch::WallSeconds();
  bool changed = true;
  while (!stop()) {
    if (auto taken = take_marks()) {
      if (!*taken && problem.ok()) problem = taken->error();
      if (*taken) marks = std::move(*taken).value();
      marks_ns.clear();
      for (const ReplayMark& mark : marks) marks_ns.push_back(mark.time_ns);
      changed = true;
    }
    changed = ReadEvents(player, marks_ns) || changed;
    if (!open_) break;
    const double now_s = launch::WallSeconds();
    if (!player.paused()) {
      player.Advance(std::min(now_s - looked_s, kLongestTick_s));
      changed = true;
    }
    looked_s = now_s;
    if (!changed) {
      SDL_WaitEventTimeout(nullptr, kWait_ms);
      continue;
    }
    changed = false;
    auto moment = moment_at(player.now_ns());
    if (!moment) player.Pause();
    Timeline timeline = TimelineOf(player, marks);
    if (moment) {
      shown_ = std::move(moment).value();
    } else {
      timeline.note = moment.error().message;
      if (problem.ok()) problem = moment.error();
    }
    screen_->Show(shown_, player.speed(), std::move(timeline));
    changed = screen_->is_restless();
    const double rest_s = pace_.Next(now_s, screen_->surface().beat()) - launch::WallSeconds();
    if (rest_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(rest_s));
  }
  return problem;
}

// Whether anything came.
bool ReplayWindow::ReadEvents(scene::Player& player, const std::vector<std::int64_t>& marks_ns) {
  bool any = false;
  for (SDL_Event event; SDL_PollEvent(&event) != 0; any = true) Take(event, player, marks_ns);
  if (screen_->asked_to_close()) open_ = false;
  return any;
}

void ReplayWindow::Take(const SDL_Event& event, scene::Player& player, const std::vector<std::int64_t>& marks_ns) {
  switch (event.type) {
    case SDL_QUIT:
      open_ = false;
      break;
    case SDL_KEYDOWN:
      if (event.key.keysym.sym == SDLK_ESCAPE) {
        open_ = false;
      } else if (event.key.repeat == 0 && screen_->TakeKey(event.key.keysym.sym, false, event.key.keysym.mod)) {
        break;
      } else if (event.key.repeat == 0 || event.key.keysym.sym == SDLK_LEFT || event.key.keysym.sym == SDLK_RIGHT) {
        TakeReplayKey(player, marks_ns, event.key.keysym.sym, event.key.keysym.mod);
      }
      break;
    case SDL_MOUSEBUTTONDOWN:
      drags_ = event.button.button == SDL_BUTTON_LEFT;
      drags_ = drags_ && Bar().Holds(screen_->surface().height_px() - 1 - event.button.y);
      if (drags_)
        Drag(event.button.x, player);
      else
        (void)screen_->TakeMouse(event);
      break;
    case SDL_MOUSEMOTION:
      if (drags_)
        Drag(event.motion.x, player);
      else
        (void)screen_->TakeMouse(event);
      break;
    case SDL_MOUSEWHEEL:
      (void)screen_->TakeMouse(event);
      break;
    case SDL_MOUSEBUTTONUP:
      if (!drags_) (void)screen_->TakeMouse(event);
      drags_ = false;
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) drags_ = false;
      break;
    default:
      break;
  }
}

TimelinePlace ReplayWindow::Bar() const {
  return TimelinePlace(PanelsOf(screen_->surface().width_px(), screen_->surface().height_px()));
}

void ReplayWindow::Drag(int x_px, scene::Player& player) {
  const double share = Bar().ShareAt(x_px);
  player.Seek(static_cast<std::int64_t>(share * static_cast<double>(player.end_ns())));
}

}  // namespace rodeira::nodes

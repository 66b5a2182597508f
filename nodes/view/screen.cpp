#include "nodes/view/screen.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/base/user_folders.hpp"
#include "common/hands/key_names.hpp"
#include "common/launch/live_keys.hpp"
#include "common/scene/pick.hpp"
#include "nodes/view/heard.hpp"
#include "nodes/view/png.hpp"

namespace rodeira::view {
namespace {

constexpr double kNote_s = 3.0;      // how long a note stands
constexpr int kClick_px = 4;          // moved farther it is no click
constexpr double kZoom = 1.15;       // a notch of the mouse's wheel
constexpr double kTurn_rad = 0.006;  // a pixel that it is drawn

// A car where the world's start is: what the first picture is drawn with, so that everything is loaded before it counts.
Picture FirstPicture(const road::World& world) {
  Picture picture;
  scene::CarPose car;
  const road::StartPose& start = world.start();
  car.p_WB_W = {start.x_m, start.y_m, world.At(start.x_m, start.y_m).z_m};
  car.q_WB = scene::Attitude(start.heading_rad, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.2 : -1.2, i % 2 == 0 ? 0.7 : -0.7, 0.29};
  picture.moment.cars.push_back(car);
  return picture;
}

}  // namespace

std::string WindowHelp() {
  std::string text;
  for (const hands::WindowKey& key : hands::WindowKeys()) {
    if (!key.does.empty()) text += fmt::format("{}{}  {}", text.empty() ? "" : "\n", key.name, key.does);
  }
  return text;
}

base::Result<std::unique_ptr<Screen>> Screen::Open(SurfaceKind kind, const ViewSettings& settings, const road::World& world,
                                                   bool resizable, std::string help) {
  const std::string title = world.name().empty() ? "Rodeira" : fmt::format("Rodeira: {}", world.name());
  auto surface = Surface::Open(kind, settings.width_px, settings.height_px, title, resizable, settings.display);
  if (!surface) return surface.error();
  if (settings.full_screen) surface.value()->ToggleFullScreen();
  std::unique_ptr<Screen> screen(new Screen());
  screen->surface_ = std::move(surface).value();
  auto painter = PainterOf(*screen->surface_, world, settings.built);
  if (!painter) return painter.error();
  screen->painter_ = std::move(painter).value();
  screen->painter_->DrawWhole(FirstPicture(world));
  (void)screen->painter_->Read();
  screen->help_text_ = std::move(help);
  screen->title_ = world.name().empty() ? "rodeira" : world.name();
  std::replace(screen->title_.begin(), screen->title_.end(), '/', '-');
  screen->live_ = PictureOf(settings, {});
  if (kind == SurfaceKind::kWindow && settings.sound) {
    auto speaker = Speaker::Open();
    if (speaker) screen->speaker_ = std::move(speaker).value();
    else fmt::print(stderr, "rodeira: no sound: {}\n", speaker.error().Text());
    screen->volume_ = settings.volume;
  }
  if (settings.mirrors != screen->kNoMirrors) screen->mirrors_ = settings.mirrors;
  return screen;
}

bool Screen::TakeKey(int symbol, bool driven) {
  switch (symbol) {
    case SDLK_k:
      live_.camera = scene::NextCamera(live_.camera);
      return true;
    case SDLK_TAB: {
      const std::size_t cars = live_.moment.cars.size(), all = cars + live_.moment.agents.size();
      live_.followed = all == 0 ? 0 : (live_.followed + 1) % all;
      followed_agent_ = live_.followed < cars || all == 0 ? std::nullopt : std::optional(live_.moment.agents[live_.followed - cars].id);
      return true;
    }
    case SDLK_h: help_ = !help_; return true;
    case SDLK_F4: live_.mirrors = live_.mirrors == kNoMirrors ? mirrors_ : kNoMirrors; return true;
    case SDLK_F12: picture_wanted_ = true; return true;
    case SDLK_F5: muted_ = !muted_; return true;
    case SDLK_F3: statistics_ = !statistics_; return true;
    case SDLK_s:
      if (driven) return false;
      statistics_ = !statistics_;
      return true;
    case SDLK_f: surface_->ToggleFullScreen(); return true;
    default: return false;
  }
}

bool Screen::TakeMouse(const SDL_Event& event, bool driven) {
  if (event.type == SDL_MOUSEWHEEL) {
    live_.aim.Zoom(std::pow(kZoom, -event.wheel.y));
    return true;
  }
  if (driven) return false;
  if (event.type == SDL_MOUSEBUTTONDOWN && event.button.button == SDL_BUTTON_LEFT) {
    dragged_px_ = 0;
    return false;
  }
  if (event.type == SDL_MOUSEBUTTONUP && event.button.button == SDL_BUTTON_LEFT && dragged_px_ <= kClick_px) {
    // Nobody who is looked at from the driver's seat sits in its own way.
    const bool inside = live_.camera == scene::CameraKind::kDriver || live_.camera == scene::CameraKind::kBonnet;
    const scene::Ray ray = scene::RayAt(painter_->CameraOf(live_), {event.button.x, event.button.y}, surface_->width_px(), surface_->height_px());
    chosen_.Choose(live_.moment, scene::BodyOn(live_.moment, ray, inside ? std::optional(live_.followed) : std::nullopt));
    return true;
  }
  if (event.type == SDL_MOUSEMOTION && (event.motion.state & SDL_BUTTON_LMASK) != 0) dragged_px_ += std::abs(event.motion.xrel) + std::abs(event.motion.yrel);
  const bool turns = event.type == SDL_MOUSEMOTION && (event.motion.state & SDL_BUTTON_LMASK) != 0;
  if (!turns) return false;
  live_.aim.Turn(kTurn_rad * event.motion.xrel, kTurn_rad * event.motion.yrel);
  return true;
}

// A car of the traffic that has left is followed no more.
void Screen::Follow() {
  const std::size_t cars = live_.moment.cars.size();
  if (followed_agent_) {
    const auto& agents = live_.moment.agents;
    const auto found = std::find_if(agents.begin(), agents.end(), [&](const scene::AgentPose& agent) { return agent.id == *followed_agent_; });
    if (found != agents.end()) {
      live_.followed = cars + static_cast<std::size_t>(found - agents.begin());
      return;
    }
    followed_agent_.reset();
    live_.followed = 0;
  }
  if (live_.followed >= cars) live_.followed = 0;
}

// What the window shows now, without notes, into the user's pictures: the time in its name is simulated.
void Screen::TakePicture() {
  picture_wanted_ = false;
  painter_->DrawWhole(live_);
  const std::filesystem::path folder = base::UserDataFolder() / "pictures";
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  const std::string stem = fmt::format("{}-{:.2f}s", title_, static_cast<double>(live_.moment.time_ns) * 1e-9);
  std::filesystem::path file = folder / (stem + ".png");
  for (int number = 2; std::filesystem::exists(file); ++number) file = folder / fmt::format("{}-{}.png", stem, number);
  const base::Status written = WritePng(file, painter_->Read());
  note_ = written ? "written: " + file.string() : written.error().Text();
  note_until_s_ = launch::WallSeconds() + kNote_s;
}

void Screen::Show(scene::Moment moment, double rate, std::optional<Timeline> timeline) {
  const double begin_s = launch::WallSeconds();
  live_.moment = std::move(moment);
  live_.timeline = std::move(timeline);
  Follow();
  live_.chosen = chosen_.In(live_.moment);
  live_.panel = chosen_.Panel(live_.moment);
  live_.text = help_ ? help_text_ : "";
  if (statistics_) {
    live_.text += fmt::format("{}{:.0f} pictures/s, {:.1f} ms each\ntime x {:.2f}\n{}", help_ ? "\n\n" : "", 1.0 / interval_s_,
                              frame_s_ * 1e3, rate, surface_->renderer());
  }
  // In slow motion it is fainter, and silent where time stands.
  if (speaker_) speaker_->Play(HeardBy(live_.moment, live_.followed, muted_ ? 0.0 : volume_ * std::min(std::fabs(rate), 1.0)), interval_s_);
  if (picture_wanted_) TakePicture();
  if (begin_s < note_until_s_) live_.text += (live_.text.empty() ? "" : "\n\n") + note_;
  painter_->Draw(live_);
  surface_->Swap();
  const double end_s = launch::WallSeconds();
  frame_s_ += 0.1 * (end_s - begin_s - frame_s_);
  interval_s_ += 0.1 * (std::min(end_s - shown_wall_s_, 1.0) - interval_s_);
  shown_wall_s_ = end_s;
}

}  // namespace rodeira::view

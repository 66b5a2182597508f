// SPDX-License-Identifier: Apache-2.0
// What keys, the mouse and the menu change in the window, and what they ask the run for.
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "common/view/scene/camera/pick.hpp"
#include "common/world/weather/named_weather.hpp"
#include "nodes/view/window/view_window.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kClick_px = 4;         // a press that moves farther is a drag
constexpr double kZoom = 1.15;       // for each notch of the mouse's wheel
constexpr double kTurn_rad = 0.006;  // for each pixel of a drag
constexpr double kWeather_s = 8.0;   // duration of a change of weather
constexpr double kVolumeStep = 0.1;  // for each press
constexpr const char* kNoneTakes =
    "no node of this run takes requests: a node of kind scenario with 'requests: true' does";
constexpr const char* kClockElsewhere = "the run is paused on the PC where its clock is";
constexpr const char* kTooMany = "the run has not taken what was asked before";

}  // namespace

bool ViewWindow::TakeKey(int symbol, bool driven, int modifiers) {
  switch (symbol) {
    case SDLK_k:
      before_above_.reset();
      live_.camera = scene::NextCamera(live_.camera);
      return true;
    case SDLK_TAB:
      FollowNext((modifiers & KMOD_SHIFT) != 0 ? -1 : 1);
      return true;
    case SDLK_h:
      help_ = !help_;
      return true;
    case SDLK_F1:
      menu_.Toggle();
      return true;
    case SDLK_F4:
      live_.mirrors = live_.mirrors == kNoMirrors ? mirrors_ : kNoMirrors;
      return true;
    case SDLK_F12:
      picture_wanted_ = true;
      return true;
    case SDLK_F5:
      muted_ = !muted_;
      return true;
    case SDLK_F6:
      placing_ = !placing_;
      Note(placing_ ? "click where the car is to stand" : "the car stays where it is");
      return true;
    case SDLK_F2:
      AskForStart();
      return true;
    case SDLK_F7:
      AskForWeather((weather_ + 1) % weather::NamedWeathers().size());
      return true;
    case SDLK_F10:
      SetVolume(std::round(volume_ / kVolumeStep - 1.0) * kVolumeStep);
      return true;  // whole steps: there and back is the same
    case SDLK_F11:
      SetVolume(std::round(volume_ / kVolumeStep + 1.0) * kVolumeStep);
      return true;
    case SDLK_F8:
      NextHeat();
      return true;
    case SDLK_F9:
      FromAboveOrBack();
      return true;
    case SDLK_F3:
      statistics_ = !statistics_;
      return true;
    case SDLK_s:
      if (driven) return false;
      statistics_ = !statistics_;
      return true;
    case SDLK_f:
      surface_->ToggleFullScreen();
      return true;
    case SDLK_SPACE:
      return is_live() && Operate(pause_monitor_.Toggle());
    case SDLK_RETURN:
      return is_live() && Operate(pause_monitor_.Step());
    default:
      return false;
  }
}

bool ViewWindow::TakeMouse(const SDL_Event& event) {
  if (menu_.Take(event)) return true;
  if (event.type == SDL_MOUSEWHEEL) {
    live_.aim.Zoom(std::pow(kZoom, -event.wheel.y));
    return true;
  }
  const bool down = event.type == SDL_MOUSEBUTTONDOWN, up = event.type == SDL_MOUSEBUTTONUP;
  if (down && event.button.button == SDL_BUTTON_LEFT && (placing_ || (SDL_GetModState() & KMOD_CTRL) != 0)) {
    placing_ = false;
    swallows_up_ = true;
    AskForPlace(event.button.x, event.button.y);
    return true;
  }
  if (up && event.button.button == SDL_BUTTON_LEFT && swallows_up_) {
    swallows_up_ = false;
    return true;
  }
  if ((down || up) && event.button.button == mouse_button_) {
    if (down)
      dragged_px_ = 0;
    else if (dragged_px_ <= kClick_px)
      ChooseAt(event.button.x, event.button.y);
    return true;
  }
  if (event.type != SDL_MOUSEMOTION || mouse_button_ == kNoButton ||
      (event.motion.state & static_cast<Uint32>(SDL_BUTTON(mouse_button_))) == 0)
    return false;
  dragged_px_ += std::abs(event.motion.xrel) + std::abs(event.motion.yrel);
  live_.aim.Turn(kTurn_rad * event.motion.xrel, kTurn_rad * event.motion.yrel);
  return true;
}

// Follows the next vehicle; cars come first, then traffic. Any other than the one at the start is also chosen.
void ViewWindow::FollowNext(int step) {
  const std::size_t cars = live_.moment.cars.size(), all = cars + live_.moment.agents.size();
  if (all == 0) return;
  live_.followed = (live_.followed + (step < 0 ? all - 1 : 1)) % all;
  followed_agent_ = live_.followed < cars ? std::nullopt : std::optional(live_.moment.agents[live_.followed - cars].id);
  const bool home = live_.followed == home_ && home_ < cars;
  chosen_.Choose(live_.moment, home ? std::nullopt : std::optional(live_.followed));
}

void ViewWindow::ChooseAt(int x_px, int y_px) {
  // The body with the eye at its driver's seat does not hide the view.
  const bool inside = live_.camera == scene::CameraKind::kDriver || live_.camera == scene::CameraKind::kBonnet;
  chosen_.Choose(live_.moment,
                 scene::BodyOn(live_.moment, RayAt(x_px, y_px), inside ? std::optional(live_.followed) : std::nullopt));
}

scene::Ray ViewWindow::RayAt(int x_px, int y_px) const {
  return scene::RayAt(renderer_->CameraOf(live_), {x_px, y_px}, surface_->width_px(), surface_->height_px());
}

void ViewWindow::AskForPlace(int x_px, int y_px) {
  const auto request = AskPlace(world_, live_.moment, live_.followed, RayAt(x_px, y_px), cars_);
  if (!request) return Note(request.error().message);
  if (!ask_) return Note(kNoneTakes);
  const scenario::Request& place = request.value();
  if (ask_(place))
    Note(fmt::format("{} to {:.1f}, {:.1f}",
                     cars_.at(live_.moment.cars[live_.followed < live_.moment.cars.size() ? live_.followed : 0].id),
                     place.x_m, place.y_m));
  else
    Note(kTooMany);
}

// The car that is followed where it began.
void ViewWindow::AskForStart() {
  const auto request = AskStart(world_, live_.moment, live_.followed, cars_, starts_);
  if (!request) return Note(request.error().message);
  if (!ask_) return Note(kNoneTakes);
  Note(ask_(request.value()) ? fmt::format("{} back to its start", request.value().argument) : kTooMany);
}

void ViewWindow::SetVolume(double volume) {
  if (!has_sound_) return Note("this window was told to be silent");
  volume_ = std::clamp(volume, 0.0, 1.0);
  muted_ = false;
  Note(fmt::format("volume {:.0f} %", 100.0 * volume_));
}

// Requests the weather `which`; it changes within kWeather_s.
void ViewWindow::AskForWeather(std::size_t which) {
  if (!ask_) return Note(kNoneTakes);
  const auto all = weather::NamedWeathers();
  weather_ = which;
  if (ask_(scenario::WeatherRequest(all[weather_].name, kWeather_s)))
    Note(fmt::format("weather: {}", all[weather_].name));
  else
    Note(kTooMany);
}

// Says so where the window has no connection to the clock. `asked`: the command was sent.
bool ViewWindow::Operate(bool asked) {
  if (!asked) Note(kClockElsewhere);
  return true;
}

// Steps through the statistics over the ground; the first step of the cycle shows none.
void ViewWindow::NextHeat() {
  const std::size_t next = heat_shown_ ? static_cast<std::size_t>(*heat_shown_) + 1 : 0;
  heat_shown_ = next < scene::kHeatKinds ? std::optional(static_cast<scene::HeatKind>(next)) : std::nullopt;
  live_.heat.reset();
  if (!heat_shown_) Note("no statistics over the ground");
}

void ViewWindow::FromAboveOrBack() {
  if (before_above_) {
    live_.camera = before_above_->camera;
    live_.aim = before_above_->aim;
    before_above_.reset();
  } else {
    before_above_ = Before{live_.camera, live_.aim};
    live_.camera = scene::CameraKind::kTop;
  }
}

// Draws the menu over the picture. A choice takes effect with the next picture.
void ViewWindow::DrawMenu() {
  MenuSight sight;
  sight.camera = live_.camera;
  sight.mirrors = live_.mirrors != kNoMirrors;
  sight.sound = has_sound_ && !muted_;
  sight.statistics = statistics_;
  sight.help = help_;
  sight.live = !live_.timeline;
  sight.volume = volume_;
  const MenuRequest request = menu_.Draw(sight, surface_->width_px(), surface_->height_px());
  if (request.key == SDLK_ESCAPE)
    asked_to_close_ = true;
  else if (request.key)
    (void)TakeKey(*request.key, true);
  if (request.weather) AskForWeather(*request.weather);
  if (request.volume) SetVolume(*request.volume);
  if (!request.camera) return;
  before_above_.reset();
  live_.camera = *request.camera;
}

}  // namespace rodeira::nodes

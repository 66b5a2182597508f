// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/window/view_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/user_folders.hpp"
#include "common/runtime/launch/live_keys.hpp"
#include "common/vehicle/input_devices/key_names.hpp"
#include "nodes/view/frame/png.hpp"
#include "nodes/view/sound/heard.hpp"
#include "nodes/view/window/loading.hpp"
#include "nodes/view/window/reading.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kNote_s = 3.0;       // how long a note stands
constexpr double kGroundShare = 0.8;  // of the time until the first picture is there

// The followed car where it begins, as the window shows it then: what the first picture is drawn with, so that
// everything is loaded before it counts.
Picture FirstPicture(const road::World& world, const ViewSettings& settings) {
  scene::CarPose car;
  const bool said = settings.followed < settings.starts.size();
  const StartPlace start = PlaceOfStart(
      world,
      said ? std::next(settings.starts.begin(), static_cast<std::ptrdiff_t>(settings.followed))->second : CarStart{});
  car.p_WB_W = {start.x_m, start.y_m, world.At(start.x_m, start.y_m).z_m};
  car.q_WB = scene::Attitude(start.heading_deg * base::kPi / 180.0, 0.0, 0.0);
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.2 : -1.2, i % 2 == 0 ? 0.7 : -0.7, 0.29};
  scene::SceneSnapshot moment;
  moment.cars.push_back(car);
  Picture picture = PictureOf(settings, std::move(moment));
  picture.followed = 0;
  return picture;
}

std::string WindowTitle(const road::World& world) {
  return world.name().empty() ? "Rodeira" : fmt::format("Rodeira: {}", world.name());
}

}  // namespace

std::string MouseHelp(int mouse_button) {
  constexpr const char* kNear = "\nmouse wheel  nearer, farther: orbit and top";
  if (mouse_button == kNoButton) return kNear;
  const char* button = mouse_button == kLeftButton ? "left" : mouse_button == kRightButton ? "right" : "middle";
  return fmt::format("\n{} mouse button  choose a vehicle; held: turn the camera orbit{}", button, kNear);
}

std::string WindowHelp(int mouse_button) {
  return input_devices::WindowKeysText([](const input_devices::WindowKey&) { return true; }) + MouseHelp(mouse_button);
}

base::Result<std::unique_ptr<ViewWindow>> ViewWindow::Open(SurfaceKind kind, const ViewSettings& settings,
                                                           const road::World& world, bool resizable, std::string help) {
  auto surface = OpenSurface(kind, settings, resizable);
  if (!surface) return surface.error();
  return Open(std::move(surface).value(), settings, world, std::move(help));
}

base::Result<std::unique_ptr<ViewWindow>> ViewWindow::Open(std::unique_ptr<Surface> surface,
                                                           const ViewSettings& settings, const road::World& world,
                                                           std::string help) {
  std::unique_ptr<ViewWindow> screen(new ViewWindow(world, settings));
  screen->cars_ = settings.cars;
  screen->starts_ = settings.starts;
  screen->paints_ = settings.paints;
  screen->surface_ = std::move(surface);
  const bool is_window = screen->surface_->kind() == SurfaceKind::kWindow;
  Loading loading(*screen->surface_, WindowTitle(world));
  double built = 0.0;
  const auto ground = [&loading, &built](double share) {
    built = std::max(built, share);
    loading.Show(kGroundShare * built, "the ground is built");
  };
  ground(0.0);
  auto renderer = RendererOf(*screen->surface_, world, settings.built, true, ground);
  if (!renderer) return renderer.error();
  screen->renderer_ = std::move(renderer).value();
  if (!settings.car_model.empty()) {
    if (auto status = screen->renderer_->UseCarModel(settings.car_model); !status)
      base::Log(base::LogLevel::kWarning, "", fmt::format("{}; the car is drawn without it", status.error().Text()));
  }
  if (built >= 1.0) loading.Show(kGroundShare, "the first picture is drawn");
  screen->renderer_->DrawWhole(FirstPicture(world, settings), ground);
  (void)screen->renderer_->Read();
  loading.Show(0.95, "the run's other parts are waited for");
  screen->help_text_ = std::move(help);
  screen->title_ = world.name().empty() ? "rodeira" : world.name();
  std::replace(screen->title_.begin(), screen->title_.end(), '/', '-');
  screen->live_ = PictureOf(settings, {});
  screen->home_ = settings.followed;
  screen->mouse_button_ = settings.mouse_button;
  if (settings.headset) screen->OpenHeadset(settings);
  if (is_window && settings.sound) {
    auto speaker = Speaker::Open();
    if (speaker)
      screen->speaker_ = std::move(speaker).value();
    else
      base::Log(base::LogLevel::kWarning, "", fmt::format("no sound: {}", speaker.error().Text()));
  }
  screen->has_sound_ = settings.sound;
  screen->volume_ = settings.sound ? settings.volume : 0.0;
  if (!settings.frame_log.empty()) {
    auto log = FrameLog::Open(settings.frame_log);
    if (!log) return log.error();
    screen->log_ = std::move(log).value();
  }
  if (settings.mirrors != screen->kNoMirrors) screen->mirrors_ = settings.mirrors;
  return screen;
}

void ViewWindow::OpenHeadset(const ViewSettings& settings) {
  auto headset = Headset::Open(surface_->quality());
  if (!headset)
    return base::Log(
        base::LogLevel::kWarning, "",
        fmt::format("no headset: {}; {}", headset.error().Text(),
                    settings.window == WindowMode::kNever ? "nothing is shown" : "shown in the window alone"));
  headset_ = std::move(headset).value();
  surface_->NeverWait();  // the headset says when
}

bool ViewWindow::WaitForHeadset() {
  if (headset_ == nullptr) return false;
  headset_waits_ = headset_->Begin();
  if (!headset_->gone().empty()) {
    base::Log(base::LogLevel::kWarning, "", headset_->gone());
    Note(headset_->gone());
    headset_.reset();
    headset_waits_ = false;
  }
  return headset_waits_;
}

// The driver's place, whatever the window shows; nothing is written over it.
void ViewWindow::ShowInHeadset() {
  Picture picture = live_;
  picture.camera = scene::CameraKind::kDriver;
  picture.show_instruments = false;
  picture.mirrors = kNoMirrors;
  picture.panel.clear();
  picture.text.clear();
  picture.timeline.reset();
  picture.heat.reset();
  headset_->Show([&](const scene::HeadsetEye& eye, const PictureTarget& target) {
    picture.eye = eye;
    renderer_->DrawInto(picture, target);
  });
  headset_waits_ = false;
}

void ViewWindow::Note(std::string note) {
  note_ = std::move(note);
  note_until_s_ = launch::WallSeconds() + kNote_s;
}

// What was seen since the window opened, whether it is shown or not; a new picture of it every half second of the
// simulation.
void ViewWindow::GatherHeat() {
  constexpr std::int64_t kAgain_ns = 500'000'000;
  heat_.Add(live_.moment);
  const std::int64_t now_ns = live_.moment.time_ns;
  if (!heat_shown_ || (live_.heat != nullptr && std::abs(now_ns - heat_laid_ns_) < kAgain_ns)) return;
  const auto body = scene::BodyAt(live_.moment, live_.followed);
  const Eigen::Vector3d about_W = body ? body->p_WB_W : Eigen::Vector3d::Zero();
  live_.heat = std::make_shared<const HeatPicture>(
      HeatPicture{*heat_shown_, heat_.watched_s(), scene::MakeHeatRaster(heat_, *heat_shown_, about_W)});
  heat_laid_ns_ = now_ns;
}

// A car of the traffic that has left is followed no more.
void ViewWindow::Follow() {
  const std::size_t cars = live_.moment.cars.size();
  if (followed_agent_) {
    const auto& agents = live_.moment.agents;
    const auto found = std::find_if(agents.begin(), agents.end(),
                                    [&](const scene::AgentPose& agent) { return agent.id == *followed_agent_; });
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
void ViewWindow::TakePicture() {
  picture_wanted_ = false;
  renderer_->DrawWhole(live_);
  const std::filesystem::path folder = base::UserDataFolder() / "pictures";
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  const std::string stem = fmt::format("{}-{:.2f}s", title_, static_cast<double>(live_.moment.time_ns) * 1e-9);
  std::filesystem::path file = folder / (stem + ".png");
  for (int number = 2; std::filesystem::exists(file); ++number) file = folder / fmt::format("{}-{}.png", stem, number);
  const base::Status written = WritePng(file, renderer_->Read());
  Note(written ? "written: " + file.string() : written.error().Text());
}

double ViewWindow::Loudness(double rate) const { return muted_ ? 0.0 : volume_ * std::min(std::fabs(rate), 1.0); }

void ViewWindow::Show(scene::SceneSnapshot moment, double rate, std::optional<Timeline> timeline) {
  const double begin_s = launch::WallSeconds();
  live_.moment = std::move(moment);
  PaintCars(live_.moment, paints_);
  live_.timeline = std::move(timeline);
  Follow();
  GatherHeat();
  live_.chosen = chosen_.In(live_.moment);
  live_.panel = chosen_.Panel(live_.moment);
  live_.driver_aim = live_.chosen && *live_.chosen < live_.moment.cars.size()
                         ? aims_.Of(live_.moment.cars[*live_.chosen])
                         : std::nullopt;
  if (live_.driver_aim) live_.panel += fmt::format("\nplans {:.0f} km/h", 3.6 * live_.driver_aim->speed_mps);
  live_.text = help_ ? help_text_ : "";
  if (statistics_) {
    live_.text += fmt::format("{}{:.0f} pictures/s, {:.1f} ms each\ntime x {:.2f}\n{}", help_ ? "\n\n" : "",
                              1.0 / interval_s_, frame_s_ * 1e3, rate, surface_->renderer());
  }
  if (speaker_) speaker_->Play(HeardBy(live_.moment, live_.followed, Loudness(rate)), interval_s_);
  if (picture_wanted_) TakePicture();
  const std::string standing = is_live() ? pause_monitor_.See(live_.moment.time_ns, begin_s) : "";
  if (!standing.empty()) live_.text += (live_.text.empty() ? "" : "\n\n") + standing;
  if (begin_s < note_until_s_) live_.text += (live_.text.empty() ? "" : "\n\n") + note_;
  if (headset_waits_) ShowInHeadset();
  if (shown_wall_s_ == 0.0) Loading::End(WindowTitle(world_));
  renderer_->Draw(live_);
  DrawMenu();
  surface_->Swap();
  const double end_s = launch::WallSeconds();
  if (log_) log_->Add(end_s, live_.moment, live_.followed, renderer_->CameraOf(live_));
  frame_s_ += 0.1 * (end_s - begin_s - frame_s_);
  interval_s_ += 0.1 * (std::min(end_s - shown_wall_s_, 1.0) - interval_s_);
  shown_wall_s_ = end_s;
}

}  // namespace rodeira::nodes

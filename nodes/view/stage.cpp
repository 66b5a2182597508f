#include "nodes/view/stage.hpp"

#include <SDL.h>
#include <fmt/format.h>

#include <chrono>

#include "common/hands/key_names.hpp"
#include "common/scene/world_scene.hpp"
#include "nodes/view/key_forwarder.hpp"
#include "nodes/view/painter.hpp"
#include "nodes/view/png.hpp"
#include "nodes/view/surface.hpp"

namespace rodeira::view {
namespace {

constexpr double kLongestRate_Hz = 60.0;

double WallSeconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// The window's own keys, and below them those of the car where one is driven from here.
std::string HelpText(const std::string& driving) {
  std::string text;
  for (const hands::WindowKey& key : hands::WindowKeys()) {
    if (!key.does.empty()) text += fmt::format("{}{}  {}", text.empty() ? "" : "\n", key.name, key.does);
  }
  return driving.empty() ? text : text + "\n\n" + driving;
}

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

struct Stage::Hand {
  std::unique_ptr<Surface> surface;
  scene::WorldScene standing;
  std::unique_ptr<Painter> painter;
  std::unique_ptr<KeyForwarder> keys;  // null: nobody drives by this window
  std::string help_text;
  Picture live;  // camera, followed car, texts as the person chose
  bool help = false;
  bool statistics = false;
  double frame_s = 0.0;      // smoothed time of drawing
  double interval_s = 0.02;  // smoothed time from picture to picture
  double shown_wall_s = 0.0;
};

Stage::Stage(const ViewSettings& settings, std::shared_ptr<const road::World> world, std::unique_ptr<launch::LiveKeysSender> keys)
    : settings_(settings), world_(std::move(world)), keys_(std::move(keys)) {
  thread_ = std::thread([this] { Run(); });
}

base::Result<std::unique_ptr<Stage>> Stage::Open(const ViewSettings& settings, std::shared_ptr<const road::World> world,
                                                 std::unique_ptr<launch::LiveKeysSender> keys) {
  std::unique_ptr<Stage> stage(new Stage(settings, std::move(world), std::move(keys)));
  {
    std::unique_lock lock(stage->mutex_);
    stage->changed_.wait(lock, [&] { return stage->ready_; });
    if (!stage->set_up_) return stage->set_up_.error();
    if (!stage->nothing_to_draw_) return stage;
  }
  return std::unique_ptr<Stage>();
}

Stage::~Stage() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool Stage::has_window() const {
  const std::lock_guard lock(mutex_);
  return window_;
}

void Stage::Show(scene::Moment moment) {
  const double wall_s = WallSeconds();
  const std::lock_guard lock(mutex_);
  history_.Add(std::move(moment));
  clock_.Arrived(wall_s, static_cast<double>(history_.newest_ns()) * 1e-9, static_cast<double>(history_.interval_ns()) * 1e-9);
}

base::Status Stage::Order(Picture picture, std::filesystem::path file) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return orders_.size() < kMostOrders || !written_; });
  if (!written_) return written_;
  orders_.push_back({std::move(picture), std::move(file)});
  changed_.notify_all();
  return {};
}

base::Status Stage::Drain() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return orders_.empty() || !written_; });
  return written_;
}

void Stage::Run() {
  Hand hand;
  base::Status status = SetUp(hand);
  const bool go_on = status.ok() && hand.painter != nullptr;
  {
    const std::lock_guard lock(mutex_);
    set_up_ = std::move(status);
    nothing_to_draw_ = hand.painter == nullptr;
    window_ = go_on && hand.surface->kind() == SurfaceKind::kWindow;
    ready_ = true;
  }
  changed_.notify_all();
  if (go_on) Loop(hand);
  hand.painter.reset();  // before its surface
  hand.surface.reset();
}

base::Status Stage::SetUp(Hand& hand) {
  const std::string title = world_->name().empty() ? "Rodeira" : fmt::format("Rodeira: {}", world_->name());
  const auto open = [&](SurfaceKind kind) -> base::Status {
    auto surface = Surface::Open(kind, settings_.width_px, settings_.height_px, title, settings_.frame_steps.empty());
    if (!surface) return surface.error();
    hand.surface = std::move(surface).value();
    return {};
  };
  if (settings_.window == WindowWish::kAlways) {
    if (auto status = open(SurfaceKind::kWindow); !status) return status;
  } else if (settings_.window == WindowWish::kAuto && HasDisplay()) {
    (void)open(SurfaceKind::kWindow);  // a display without OpenGL is as good as none
  }
  if (hand.surface == nullptr) {
    if (settings_.frame_steps.empty()) return {};
    if (auto status = open(SurfaceKind::kOffscreen); !status) return status;
  }
  hand.standing = scene::BuildWorldScene(*world_);
  hand.painter = std::make_unique<Painter>(*hand.surface, *world_, hand.standing);
  hand.standing = {};  // the painter has its own copy
  hand.painter->Draw(FirstPicture(*world_));
  (void)hand.painter->Read();
  hand.help_text = HelpText(settings_.driving_help);
  if (keys_ != nullptr) hand.keys = std::make_unique<KeyForwarder>(std::move(keys_));
  hand.live.camera = settings_.camera;
  hand.live.followed = settings_.followed;
  hand.live.show_instruments = settings_.instruments;
  return {};
}

void Stage::Loop(Hand& hand) {
  std::unique_lock lock(mutex_);
  while (!quit_) {
    if (!orders_.empty()) {
      ServeOrder(hand, lock);
    } else if (window_ && !history_.empty()) {
      ShowWindow(hand, lock);
    } else {
      changed_.wait_for(lock, std::chrono::milliseconds(window_ ? 10 : 1000), [&] { return quit_ || !orders_.empty(); });
      if (window_) window_ = ReadKeys(hand);
    }
  }
}

void Stage::ServeOrder(Hand& hand, std::unique_lock<std::mutex>& lock) {
  const Ordered& order = orders_.front();  // others are only added behind it
  lock.unlock();
  hand.painter->Draw(order.picture);
  base::Status status = WritePng(order.file, hand.painter->Read());
  lock.lock();
  if (written_) written_ = std::move(status);
  orders_.pop_front();
  changed_.notify_all();
}

void Stage::ShowWindow(Hand& hand, std::unique_lock<std::mutex>& lock) {
  const double begin_s = WallSeconds();
  const double rate = clock_.rate();
  hand.live.moment = history_.At(clock_.Now(begin_s) * 1e9);
  lock.unlock();
  const bool open = ReadKeys(hand);
  if (hand.live.followed >= hand.live.moment.cars.size()) hand.live.followed = 0;
  hand.live.text = hand.help ? hand.help_text : "";
  if (hand.statistics) {
    hand.live.text += fmt::format("{}{:.0f} pictures/s, {:.1f} ms each\ntime x {:.2f}\n{}", hand.help ? "\n\n" : "", 1.0 / hand.interval_s, hand.frame_s * 1e3, rate,
                                  hand.surface->renderer());
  }
  hand.painter->Draw(hand.live);
  hand.surface->Swap();
  const double end_s = WallSeconds();
  hand.frame_s += 0.1 * (end_s - begin_s - hand.frame_s);
  hand.interval_s += 0.1 * (std::min(end_s - hand.shown_wall_s, 1.0) - hand.interval_s);
  hand.shown_wall_s = end_s;
  lock.lock();
  if (!open) window_ = false;
  // Where the display does not hold us back, we do it ourselves.
  const double rest_s = 1.0 / kLongestRate_Hz - (WallSeconds() - begin_s);
  if (rest_s > 0.0) changed_.wait_for(lock, std::chrono::duration<double>(rest_s), [&] { return quit_ || !orders_.empty(); });
}

// False where the person closed the window.
bool Stage::ReadKeys(Hand& hand) {
  SDL_Event event;
  bool open = true;
  while (SDL_PollEvent(&event) != 0) {
    if (event.type == SDL_QUIT) open = false;
    if (event.type == SDL_KEYDOWN && event.key.repeat == 0 && event.key.keysym.sym == SDLK_ESCAPE) open = false;
    const bool own = event.type == SDL_KEYDOWN && event.key.repeat == 0 && TakeOwnKey(hand, event.key.keysym.sym);
    if (!own && hand.keys != nullptr) hand.keys->Take(event);
  }
  if (hand.keys != nullptr) {
    if (!open) hand.keys->ReleaseAll();
    hand.keys->Tell(launch::WallSeconds());
  }
  if (!open) hand.surface->Hide();
  return open;
}

// Whether the key is the window's own and not the car's.
bool Stage::TakeOwnKey(Hand& hand, int symbol) {
  switch (symbol) {
    case SDLK_k: hand.live.camera = hand.live.camera == scene::CameraKind::kChase ? scene::CameraKind::kDriver : scene::CameraKind::kChase; return true;
    case SDLK_TAB: ++hand.live.followed; return true;
    case SDLK_h: hand.help = !hand.help; return true;
    case SDLK_F3: hand.statistics = !hand.statistics; return true;
    case SDLK_s:  // the brake of w a s d, where somebody drives
      if (hand.keys != nullptr) return false;
      hand.statistics = !hand.statistics;
      return true;
    case SDLK_f: hand.surface->ToggleFullScreen(); return true;
    case SDLK_ESCAPE: return true;
    default: return false;
  }
}

}  // namespace rodeira::view

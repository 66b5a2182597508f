// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/view_settings.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "common/core/base/suggest.hpp"
#include "common/runtime/launch/lab.hpp"
#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

// The cars' streams, as the view's port is wired.
std::vector<lockstep::SourceIndex> CarSources(const lockstep::RosterNode& view) {
  for (const lockstep::Port& port : view.inputs) {
    if (port.topic == idl::topics::kVehicleState) return port.sources;
  }
  return {};
}

void ReadFollowed(const lockstep::Roster& roster, const lockstep::RosterNode& view, const config::Map& map,
                  ViewSettings& settings) {
  if (!map.Has("follow")) return;
  const auto followed = FindFollowed(roster, CarSources(view), map.Text("follow"));
  if (followed)
    settings.followed = followed.value();
  else
    map.Problem("follow", followed.error().id, followed.error().message);
}

void ReadPaints(const lockstep::Roster& roster, const lockstep::RosterNode& view, const config::Map& map,
                ViewSettings& settings) {
  const auto cars = CarSources(view);
  for (const std::string& name : map.Keys()) {
    const auto car = FindFollowed(roster, cars, name);
    const auto paint = PaintOf(map.Text(name));
    if (!car)
      map.Problem(name, car.error().id, car.error().message);
    else if (!paint)
      map.Problem(name, paint.error().id, paint.error().message);
    else
      settings.paints[cars[car.value()]] = paint.value();
  }
}

void ReadScreen(const launch::Launch& launch, const config::Map& map, ViewSettings& settings) {
  if (!map.Has("screen")) return;
  const std::string name = map.Text("screen");
  if (launch.lab().empty())
    return map.Problem("screen", "config.conflicting_keys",
                       "'screen' names one of a laboratory, but the launch file names no 'lab'");
  const auto lab = launch::Lab::Load(launch.lab());
  if (!lab) return map.Problem("screen", lab.error().id, lab.error().Text());
  const auto screen = lab.value().Screen(name);
  if (!screen) return map.Problem("screen", screen.error().id, screen.error().Text());
  std::vector<scene::ScreenPlane> planes;
  std::size_t which = 0;
  for (const launch::LabScreen& s : lab.value().screens()) {
    if (s.name == name) which = planes.size();
    planes.push_back({s.width_m, s.height_m, s.distance_m, s.angle_rad, s.eye_height_m, s.aside_m});
  }
  settings.screen = planes[which];
  settings.mirrors = scene::MirrorsOn(planes, which);
}

// A film instead of single pictures.
void ReadFilm(const launch::NodeContext& context, const config::Map& frames, ViewSettings& settings) {
  const double fps = frames.Number("fps", {0.01, kMaxFps}), from_s = frames.Number("from_s", {0.0, 1e6}, 0.0),
               to_s = frames.Number("to_s", {0.0, 1e6});
  auto steps = FilmSteps(context.roster(), CarSources(context.spec()), fps, from_s, to_s);
  if (steps)
    settings.frame_steps = std::move(steps).value();
  else
    frames.Problem("fps", steps.error().id, steps.error().message);
}

void ReadTimes(const launch::NodeContext& context, const config::Map& frames, ViewSettings& settings) {
  for (const double time_s : frames.Numbers("times_s", {0.0, 1e9})) {
    const auto step = FrameStep(context.roster(), CarSources(context.spec()), time_s);
    if (step)
      settings.frame_steps.push_back(step.value());
    else
      frames.Problem("times_s", step.error().id, step.error().message);
  }
  std::sort(settings.frame_steps.begin(), settings.frame_steps.end());
  settings.frame_steps.erase(std::unique(settings.frame_steps.begin(), settings.frame_steps.end()),
                             settings.frame_steps.end());
}

// Buttons of the wheel that a launch file names by its file, or of those that may drive where it names none.
void ReadWheelButtons(const launch::Launch& launch, const launch::LaunchNode& node, ViewSettings& settings) {
  const auto file = node.config->Peek({"config", "wheel"});
  if (!file || *file == "~") {
    settings.camera_buttons.push_back({"", 0, true});
    return settings.camera_buttons.push_back({"", kPadCameraButton});
  }
  const auto wheel = input_devices::PeekWheel((launch.path().parent_path() / *file).lexically_normal(),
                                              [&](const std::string& device) {
                                                return node.config->Peek({"config", "devices", device});
                                              });
  const auto& use = wheel ? wheel->buttons[static_cast<std::size_t>(input_devices::WheelButton::kCamera)]
                          : std::optional<input_devices::ButtonUse>();
  if (use) settings.camera_buttons.push_back({wheel->devices[use->device].guid, static_cast<int>(use->button)});
}

bool Drives(const input_devices::KeyboardSettings& keyboard, int mouse_button) {
  const auto holds = [&](const std::vector<input_devices::Key>& keys) {
    return std::find(keys.begin(), keys.end(), input_devices::kMouse + static_cast<input_devices::Key>(mouse_button)) !=
           keys.end();
  };
  return std::any_of(std::begin(keyboard.keys), std::end(keyboard.keys), holds);
}

// The first button from this one on, in the order in which a window takes one, that the keyboard file leaves alone.
int FreeButton(const input_devices::KeyboardSettings& keyboard, int mouse_button) {
  constexpr std::array kOrder = {kLeftButton, kRightButton, kMiddleButton};
  for (auto button = std::find(kOrder.begin(), kOrder.end(), mouse_button); button != kOrder.end(); ++button) {
    if (!Drives(keyboard, *button)) return *button;
  }
  return kNoButton;
}

// Whether an input of the run drives by its windows' keys, and by which. What is wrong there the input itself says.
void ReadDriving(const launch::Launch& launch, ViewSettings& settings) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "input") continue;
    const auto source = node.config->Peek({"config", "source"});
    if (source == "joystick") ReadWheelButtons(launch, node, settings);
    if (source == "gamepad") settings.camera_buttons.push_back({"", kPadCameraButton});
    const auto file = node.config->Peek({"config", "keyboard"}), wheel = node.config->Peek({"config", "wheel"});
    const bool falls_back =
        source == "joystick" && file && (!wheel || *wheel == "~");  // keys drive where no wheel is found
    if (source != "keyboard" && !falls_back) continue;
    settings.drives = true;
    if (!file) continue;
    const auto keyboard = input_devices::LoadKeyboard((launch.path().parent_path() / *file).lexically_normal());
    if (!keyboard) continue;
    settings.driving_help = input_devices::KeyboardHelp(keyboard.value());
    settings.mouse_button = FreeButton(keyboard.value(), settings.mouse_button);
  }
}

void ReadMirrors(const config::Map& map, ViewSettings& settings) {
  settings.mirrors = {};
  const config::List names = map.Items("mirrors");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names.Text(i);
    if (const auto mirror = scene::MirrorOf(name))
      settings.mirrors[static_cast<std::size_t>(*mirror)] = true;
    else
      names.Problem(i, "config.unknown_name",
                    fmt::format("'{}' is no mirror{}", name, base::DidYouMean(name, {"left", "inside", "right"})));
  }
}

// Where the launch file says that a vehicle begins; what is wrong there the vehicle says itself.
CarStart ReadStart(const launch::LaunchNode& vehicle) {
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto text = vehicle.config->Peek({"config", "start", key});
    double value = 0.0;
    if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{})
      return std::nullopt;
    return value;
  };
  return {number("x_m"), number("y_m"), number("heading_deg")};
}

// All but the frames.
ViewSettings ReadWindow(const launch::Launch& launch, const lockstep::RosterNode& view, const config::Map& map) {
  ViewSettings settings;
  settings.width_px = static_cast<int>(map.Integer("width_px", 64, 7680, 1280));
  settings.height_px = static_cast<int>(map.Integer("height_px", 64, 4320, 720));
  const auto cameras = scene::CameraNames();
  ReadScreen(launch, map, settings);
  settings.camera =
      scene::CameraOf(map.Choice("camera", {cameras.begin(), cameras.end()}, settings.screen ? "driver" : "chase"))
          .value_or(scene::CameraKind::kChase);
  if (map.Has("quality"))
    settings.quality = QualityOf(map.Choice("quality", {QualityNames().begin(), QualityNames().end()}, "medium"));
  if (map.Has("frame_log")) settings.frame_log = map.Path("frame_log");
  if (map.Has("car_model")) settings.car_model = map.Path("car_model");
  settings.headset = map.Flag("headset", false);
  settings.full_screen = map.Flag("full_screen", false);
  settings.display = static_cast<int>(map.Integer("display", 0, 15, 0));
  const std::string window = map.Choice("window", {"auto", "always", "never"}, "auto");
  settings.window = window == "always"  ? WindowMode::kAlways
                    : window == "never" ? WindowMode::kNever
                                        : WindowMode::kAuto;
  settings.instruments = map.Flag("instruments", true);
  settings.sound = map.Flag("sound", true);
  settings.volume = map.Number("volume", {0.0, 1.0}, settings.volume);
  settings.cabin = map.Flag("cabin", !settings.screen);  // a laboratory has its own
  if (map.Has("mirrors")) ReadMirrors(map, settings);
  ReadFollowed(launch.roster(), view, map, settings);
  ReadPaints(launch.roster(), view, map.OptionalChild("colours"), settings);
  ReadDriving(launch, settings);
  for (const launch::LaunchNode& node : launch.nodes()) settings.can_ask = settings.can_ask || node.takes_requests();
  for (const lockstep::SourceIndex car : CarSources(view)) {
    const lockstep::NodeIndex vehicle = launch.roster().source(car).node;
    settings.cars[car] = launch.roster().node(vehicle).name;
    settings.starts[car] = ReadStart(launch.node(vehicle));
    if (auto autopilot = AutopilotOf(launch, vehicle)) settings.autopilots[car] = std::move(*autopilot);
  }
  return settings;
}

}  // namespace

base::Result<ViewSettings> ReadViewSettings(const launch::NodeContext& context) {
  const config::Map map = context.config();
  ViewSettings settings = ReadWindow(context.launch(), context.spec(), map);
  if (map.Has("frames")) {
    const config::Map frames = map.Child("frames");
    if (frames.Has("fps"))
      ReadFilm(context, frames, settings);
    else
      ReadTimes(context, frames, settings);
    settings.folder = frames.Path("folder");
    if (auto status = context.launch().file().Finish(); !status) return status.error();
    if (auto status = PrepareFolder(settings.folder); !status)
      frames.Problem("folder", status.error().id, status.error().message);
  }
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  const auto& nodes = context.launch().nodes();
  settings.waits_for_picture =
      settings.headset || (!settings.frame_steps.empty() && settings.frame_steps.front() == 0) ||
      std::any_of(nodes.begin(), nodes.end(), [](const launch::LaunchNode& node) { return node.is_live(); });
  return settings;
}

base::Result<ViewSettings> ReadWindowSettings(const launch::Launch& launch, lockstep::NodeIndex view) {
  const config::Map map = launch.node(view).config->OptionalChild("config");
  ViewSettings settings = ReadWindow(launch, launch.roster().node(view), map);
  map.IgnoreKey("frames");
  if (auto status = launch.file().Finish(); !status) return status.error();
  return settings;
}

base::Result<std::size_t> FindFollowed(const lockstep::Roster& roster, const std::vector<lockstep::SourceIndex>& cars,
                                       const std::string& name) {
  std::vector<std::string> names;
  for (const lockstep::SourceIndex source : cars) names.push_back(roster.node(roster.source(source).node).name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return base::WrongInput("launch.not_wired", fmt::format("'{}' is no vehicle that this view is wired to{}", name,
                                                          base::DidYouMean(name, names)));
}

base::Result<lockstep::Step> FrameStep(const lockstep::Roster& roster, const std::vector<lockstep::SourceIndex>& cars,
                                       double time_s) {
  const double base_step_s = static_cast<double>(roster.base_step_ns()) * 1e-9;
  const double steps = time_s / base_step_s;
  const auto step = static_cast<lockstep::Step>(std::llround(steps));
  if (std::fabs(steps - static_cast<double>(step)) > 1e-6 * std::max(1.0, steps)) {
    return base::WrongInput("view.wrong_film",
                            fmt::format("{} s is no multiple of the base step of {} s", time_s, base_step_s));
  }
  for (const lockstep::SourceIndex source : cars) {
    const lockstep::Step period = roster.source(source).period;
    if (step % period == 0) continue;
    return base::WrongInput("view.wrong_film",
                            fmt::format("at {} s {} has no sample; a multiple of its period of {} s was expected",
                                        time_s, roster.SourceName(source), static_cast<double>(period) * base_step_s));
  }
  return step;
}

base::Result<std::vector<lockstep::Step>> FilmSteps(const lockstep::Roster& roster,
                                                    const std::vector<lockstep::SourceIndex>& cars, double fps,
                                                    double from_s, double to_s) {
  lockstep::Step grid = 1;
  for (const lockstep::SourceIndex source : cars) grid = std::lcm(grid, roster.source(source).period);
  const double grid_s = static_cast<double>(grid * roster.base_step_ns()) * 1e-9;
  if (!(to_s >= from_s))
    return base::WrongInput(
        "view.wrong_film",
        fmt::format("a film from {} s to {} s was found; an end behind its beginning was expected", from_s, to_s));
  if (!(fps > 0.0 && fps * grid_s <= 1.0 + 1e-9)) {
    return base::WrongInput("view.wrong_film", fmt::format("{} pictures a second were found; more than 0 and at most "
                                                           "{:g} were expected, as many as all cars have samples",
                                                           fps, 1.0 / grid_s));
  }
  std::vector<lockstep::Step> steps;
  for (std::int64_t k = 0;; ++k) {
    const double time_s = from_s + static_cast<double>(k) / fps;
    if (time_s > to_s + 1e-9) return steps;
    steps.push_back(grid * static_cast<lockstep::Step>(std::llround(time_s / grid_s)));
  }
}

base::Status PrepareFolder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder)) {
    return base::WrongInput("file.not_folder",
                            fmt::format("'{}' is no folder, and none can be made ({})", folder.string(),
                                        problem ? problem.message() : "something else lies there"));
  }
  std::string attempt = (folder / ".rodeira-XXXXXX").string();
  const int file = ::mkstemp(attempt.data());
  if (file < 0)
    return base::WrongInput("file.cannot_write",
                            fmt::format("'{}' cannot be written to ({})", folder.string(),
                                        std::error_code(errno, std::generic_category()).message()));
  ::close(file);
  std::filesystem::remove(attempt, problem);
  return {};
}

Picture PictureOf(const ViewSettings& settings, scene::SceneSnapshot moment) {
  Picture picture;
  picture.moment = std::move(moment);
  PaintCars(picture.moment, settings.paints);
  picture.camera = settings.camera;
  picture.screen = settings.screen;
  picture.followed = settings.followed;
  picture.show_instruments = settings.instruments;
  picture.mirrors = settings.mirrors;
  picture.cabin = settings.cabin;
  return picture;
}

base::Result<std::shared_ptr<const road::World>> WorldOf(const launch::Launch& launch) {
  if (!launch.world().empty()) return road::World::Load(launch.world());
  road::WorldSpec level;  // a run without a world stands on a level plane
  level.plane = road::PlaneSpec{};
  level.terrain_surface = ground::Surface::kAsphalt;
  return road::World::Make(std::move(level));
}

std::string FrameName(lockstep::Step step) { return fmt::format("step_{:09}.png", step); }

}  // namespace rodeira::nodes

#include "nodes/view/view_settings.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "common/base/suggest.hpp"
#include "common/hands/keyboard_driver.hpp"
#include "idl/topics.hpp"

namespace rodeira::view {
namespace {

// The cars' streams, as the view's port is wired.
std::vector<lockstep::SourceIndex> CarSources(const launch::NodeContext& context) {
  for (const lockstep::Port& port : context.spec().inputs) {
    if (port.topic == idl::topics::kVehicleState) return port.sources;
  }
  return {};
}

void ReadFollowed(const launch::NodeContext& context, const config::Map& map, ViewSettings& settings) {
  if (!map.Has("follow")) return;
  const std::string wanted = map.Text("follow");
  std::vector<std::string> names;
  for (const lockstep::SourceIndex source : CarSources(context)) names.push_back(context.roster().node(context.roster().source(source).node).name);
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found != names.end()) settings.followed = static_cast<std::size_t>(found - names.begin());
  else map.Problem("follow", fmt::format("'{}' is no vehicle that this view is wired to{}", wanted, base::DidYouMean(wanted, names)));
}

void ReadTimes(const launch::NodeContext& context, const config::Map& frames, ViewSettings& settings) {
  const double base_step_s = static_cast<double>(context.roster().base_step_ns()) * 1e-9;
  for (const double time_s : frames.Numbers("times_s", {0.0, 1e9})) {
    const double steps = time_s / base_step_s;
    const auto step = static_cast<lockstep::Step>(std::llround(steps));
    if (std::fabs(steps - static_cast<double>(step)) > 1e-6 * std::max(1.0, steps)) {
      frames.Problem("times_s", fmt::format("{} s is no multiple of the base step of {} s", time_s, base_step_s));
      continue;
    }
    for (const lockstep::SourceIndex source : CarSources(context)) {
      const lockstep::Step period = context.roster().source(source).period;
      if (step % period != 0) {
        frames.Problem("times_s", fmt::format("at {} s {} has no sample; a multiple of its period of {} s was expected", time_s,
                                              context.roster().SourceName(source), static_cast<double>(period) * base_step_s));
        break;
      }
    }
    settings.frame_steps.push_back(step);
  }
  std::sort(settings.frame_steps.begin(), settings.frame_steps.end());
  settings.frame_steps.erase(std::unique(settings.frame_steps.begin(), settings.frame_steps.end()), settings.frame_steps.end());
}

// Whether an input of the run drives by its windows' keys, and by which. What is wrong there the input itself says.
void ReadDriving(const launch::Launch& launch, ViewSettings& settings) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "input") continue;
    if (node.config->Peek({"config", "source"}) != "keyboard") continue;
    settings.drives = true;
    const auto file = node.config->Peek({"config", "keyboard"});
    if (!file) continue;
    const auto keyboard = hands::LoadKeyboard((launch.path().parent_path() / *file).lexically_normal());
    if (keyboard) settings.driving_help = hands::KeyboardHelp(keyboard.value());
  }
}

// Makes the folder where it is missing, and tries to write there before time is spent.
void PrepareFolder(const config::Map& frames, const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (!std::filesystem::is_directory(folder)) {
    frames.Problem("folder", fmt::format("'{}' is no folder, and none can be made ({})", folder.string(), problem ? problem.message() : "something else lies there"));
    return;
  }
  std::string attempt = (folder / ".rodeira-XXXXXX").string();
  const int file = ::mkstemp(attempt.data());
  if (file < 0) {
    frames.Problem("folder", fmt::format("'{}' cannot be written to ({})", folder.string(), std::error_code(errno, std::generic_category()).message()));
    return;
  }
  ::close(file);
  std::filesystem::remove(attempt, problem);
}

}  // namespace

base::Result<ViewSettings> ReadViewSettings(const launch::NodeContext& context) {
  const config::Map map = context.config();
  ViewSettings settings;
  settings.width_px = static_cast<int>(map.Integer("width_px", 64, 7680, 1280));
  settings.height_px = static_cast<int>(map.Integer("height_px", 64, 4320, 720));
  settings.camera = map.Choice("camera", {"chase", "driver"}, "chase") == "driver" ? scene::CameraKind::kDriver : scene::CameraKind::kChase;
  const std::string window = map.Choice("window", {"auto", "always", "never"}, "auto");
  settings.window = window == "always" ? WindowWish::kAlways : window == "never" ? WindowWish::kNever : WindowWish::kAuto;
  settings.instruments = map.Flag("instruments", true);
  ReadFollowed(context, map, settings);
  ReadDriving(context.launch(), settings);
  if (map.Has("frames")) {
    const config::Map frames = map.Child("frames");
    ReadTimes(context, frames, settings);
    settings.folder = frames.Path("folder");
    if (auto status = context.launch().file().Finish(); !status) return status.error();
    PrepareFolder(frames, settings.folder);
  }
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  return settings;
}

std::string FrameName(lockstep::Step step) { return fmt::format("step_{:09}.png", step); }

}  // namespace rodeira::view

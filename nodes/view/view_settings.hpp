#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/launch/node_context.hpp"
#include "common/scene/camera.hpp"

namespace rodeira::view {

enum class WindowWish { kAuto, kAlways, kNever };

// What the launch file says under `nodes.NAME.config`.
struct ViewSettings {
  int width_px = 1280;
  int height_px = 720;
  scene::CameraKind camera = scene::CameraKind::kChase;
  WindowWish window = WindowWish::kAuto;
  bool instruments = true;
  std::size_t followed = 0;                  // which of the cars wired to the view, in the roster's order
  std::vector<lockstep::Step> frame_steps;   // ascending, each once
  std::filesystem::path folder;              // of the frames
  bool drives = false;                       // somebody in this run drives by the keys of its windows …
  std::string driving_help;                  // … by these
};

// Reads the settings. Wrong input where a frame's time is not one at which every car wired to the view has a sample, where
// the folder cannot be made or written to, or where the car to follow is none of the view's.
base::Result<ViewSettings> ReadViewSettings(const launch::NodeContext& context);

// "step_000012340.png": the frame of a step.
std::string FrameName(lockstep::Step step);

}  // namespace rodeira::view

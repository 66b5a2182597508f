// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/launch/node_context.hpp"
#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/camera/mirror.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/dynamic_objects/driver_aims.hpp"
#include "nodes/view/dynamic_objects/paint.hpp"
#include "nodes/view/frame/picture.hpp"
#include "nodes/view/frame/quality.hpp"
#include "nodes/view/run_connection/ask_place.hpp"
#include "nodes/view/window/wheel_buttons.hpp"

namespace rodeira::nodes {

enum class WindowMode { kAuto, kAlways, kNever };

// Buttons of the mouse, by SDL's numbers.
inline constexpr int kNoButton = 0, kLeftButton = 1, kMiddleButton = 2, kRightButton = 3;

// What the launch file says under `nodes.NAME.config`.
struct ViewSettings {
  int width_px = 1280;
  int height_px = 720;
  scene::CameraKind camera = scene::CameraKind::kChase;
  std::optional<scene::ScreenPlane> screen;  // of the laboratory, for the driver's camera
  std::optional<Quality> quality;            // none: the renderer's own (Surface::Open)
  bool headset = false;                      // the driver's place is shown there too
  bool waits_for_picture = true;  // the run begins when everything is drawn once; else when the world is read
  bool full_screen = false;
  int display = 0;  // of the PC, for the window
  WindowMode window = WindowMode::kAuto;
  bool instruments = true;
  bool sound = true;    // of a window
  double volume = 0.6;  // 0 … 1
  bool cabin = true;    // dashboard and steering wheel, likewise
  std::array<bool, scene::kMirrors> mirrors = {true, true,
                                               true};  // of the driver's camera; without a word those of its screen
  std::size_t followed = 0;                            // which of the cars wired to the view, in the roster's order
  std::vector<lockstep::Step> frame_steps;             // ascending, each once
  std::filesystem::path folder;                        // of the frames
  std::filesystem::path frame_log;                     // of a window's pictures; empty: none
  std::filesystem::path built;      // the folder of a database of the world; empty: its ground is built in memory
  std::filesystem::path car_model;  // of driven cars; empty: the procedural one
  bool drives = false;              // a person in this run drives by the keys of its windows …
  std::string driving_help;         // … by these
  int mouse_button =
      kLeftButton;  // the window's own: the first of left, right, middle that no car of the run is driven by
  std::vector<WheelButtonUse> camera_buttons;  // of wheels that drive in this run
  bool can_ask = false;                        // a scenario of this run makes events of what windows ask for
  CarNames cars;                               // wired to the view
  CarPaints paints;                            // of those among them that were given one
  CarAutopilots autopilots;                    // of those among them that one drives
  CarStarts starts;                            // of those among them with a vehicle node that says one
};

// Reads the settings. Wrong input where a frame's time is not one at which every car wired to the view has a sample,
// where the folder cannot be made or written to, or where the car to follow is none of the view's.
base::Result<ViewSettings> ReadViewSettings(const launch::NodeContext& context);

// The same, without its frames: those are left alone. `view`: a node of kind view.
base::Result<ViewSettings> ReadWindowSettings(const launch::Launch& launch, lockstep::NodeIndex view);

// Which of the cars (their sources, as the view is wired) a node's name means. Wrong input with the nearest name where
// none.
base::Result<std::size_t> FindFollowed(const lockstep::Roster& roster, const std::vector<lockstep::SourceIndex>& cars,
                                       const std::string& name);

// The step of a frame's time. Wrong input where it is no multiple of the base step, or a car has no sample then.
base::Result<lockstep::Step> FrameStep(const lockstep::Roster& roster, const std::vector<lockstep::SourceIndex>& cars,
                                       double time_s);

// The steps of a film's pictures: the one at which all cars have samples that is nearest to from_s + k / fps, for each
// k up to to_s. Wrong input where they have fewer samples a second than it has pictures, or the end lies before the
// beginning.
base::Result<std::vector<lockstep::Step>> FilmSteps(const lockstep::Roster& roster,
                                                    const std::vector<lockstep::SourceIndex>& cars, double fps,
                                                    double from_s, double to_s);
inline constexpr double kMaxFps = 1'000.0;

// Makes a folder for frames where it is missing, and tries to write there before time is spent.
base::Status PrepareFolder(const std::filesystem::path& folder);

// The picture of a frame.
Picture PictureOf(const ViewSettings& settings, scene::SceneSnapshot moment);

// The world of the run; a run without one stands on a level plane of asphalt.
base::Result<std::shared_ptr<const road::World>> WorldOf(const launch::Launch& launch);

// "step_000012340.png": the frame of a step.
std::string FrameName(lockstep::Step step);

}  // namespace rodeira::nodes

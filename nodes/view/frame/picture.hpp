// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/camera/headset_eye.hpp"
#include "common/view/scene/camera/mirror.hpp"
#include "common/view/scene/heat_map/heat_raster.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::nodes {

// The bar of a recording's time at the bottom of a picture. Places are shares of the run, from 0 to 1.
struct Timeline {
  double share = 0.0;          // now
  std::vector<double> marks;   // of the operator, and faults
  std::string where;           // time, speed, direction
  std::string note;            // the mark that is near
  std::string keys;            // the most important ones
  std::vector<double> events;  // of scenarios
};

// A statistic over the ground, as it was gathered up to a moment.
struct HeatPicture {
  scene::HeatKind kind = scene::HeatKind::kSpeed;
  double watched_s = 0.0;
  scene::HeatRaster raster;
};

// What the driver of a chosen vehicle goes by.
struct DriverAim {
  double speed_mps = 0.0;  // planned
  Eigen::Vector2d target_B =
      Eigen::Vector2d::Zero();  // the point that is steered for, ahead and to the left of the car
  double path_turn_rad = 0.0;   // where the path leads beside the car, from its heading, positive to the left
  Eigen::Vector2d look_ahead_W = Eigen::Vector2d::Zero();  // up to where the driver looks for what slows the car
};

// What one picture shows.
struct Picture {
  scene::SceneSnapshot moment;
  scene::CameraKind camera = scene::CameraKind::kChase;
  scene::Aim aim;                            // of the cameras that a hand moves
  std::optional<scene::ScreenPlane> screen;  // through which the driver's camera looks
  std::optional<scene::HeadsetEye> eye;      // that the driver's camera is instead
  std::size_t followed = 0;                  // what the camera goes with: the moment's cars, then its traffic
  std::optional<std::size_t> chosen;         // what a person looks at, counted likewise: it pulses
  std::optional<DriverAim> driver_aim;       // of the chosen one's driver, where it is a driven car; what the traffic's
                                             // drivers go by is in the moment
  std::string panel;                         // lines about it
  bool show_instruments = true;              // speed, gear, time
  bool cabin = false;                        // dashboard and steering wheel before the driver's camera
  std::array<bool, scene::kMirrors> mirrors = {true, true,
                                               true};  // left, inside, right: shown with the driver's camera
  std::string text;                                    // more lines for a person: help, statistics
  std::shared_ptr<const HeatPicture> heat;             // null: none
  std::optional<Timeline> timeline;                    // of a recording that is watched
};

// Rows from the top, three bytes a pixel: red, green, blue.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgb;

  // The three bytes of a pixel; y counts from the top. Precondition: within the picture.
  const std::uint8_t* At(int x_px, int y_px) const {
    return &rgb[3 *
                (static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x_px))];
  }
};

}  // namespace rodeira::nodes

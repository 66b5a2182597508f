// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string_view>

#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::scene {

enum class CameraKind { kChase, kDriver, kBonnet, kOrbit, kTop, kTrackside };

// "chase", "driver", "bonnet", "orbit", "top", "trackside": as settings and options name them, in the order of the
// kinds.
std::span<const std::string_view> CameraNames();
// The kind of that name; nothing where there is none.
std::optional<CameraKind> CameraOf(std::string_view name);
// The kind behind it; behind the last one the first.
CameraKind NextCamera(CameraKind kind);

// From where and whereto one looks: a pure function of the car's pose (and of the world, and of what a hand on the
// mouse has set), so that the camera is always in the same moment as the car.
struct Camera {
  Eigen::Vector3d eye_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d forward_W = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d up_W = Eigen::Vector3d::UnitZ();       // unit, square to forward
  double vertical_view_rad = 0.8;
  double parallel_height_m = 0.0;  // > 0: parallel rays, and so much of the world from the lower to the upper edge
  // Where the picture's edges lie at a unit of depth, right and up positive, for an eye that does not sit before its
  // middle.
  struct Window {
    double left = -1.0, right = 1.0, low = -1.0, high = 1.0;
  };
  std::optional<Window> window;  // none: as the vertical view says, whatever the picture's shape

  // Pixels from the left and from the top of a picture of that size; nothing for points behind the eye.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& p_W, int width_px, int height_px) const;
};

// From an eye along `forward` (any length), level as `up` says, which must not point the same way.
Camera LookFrom(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& forward, const Eigen::Vector3d& up,
                double vertical_view_rad);

// What a camera goes with: a driver's car, or one of the traffic.
struct Body {
  Body(const CarPose& car);
  Body(const AgentPose& agent);

  Eigen::Vector3d p_WB_W;
  Eigen::Quaterniond q_WB;
  double length_m, front_m, width_m, height_m;  // front_m: of the front bumper from B's origin
};
// One of the moment's cars or, numbered behind them, of its traffic; none behind those.
std::optional<Body> BodyAt(const SceneSnapshot& moment, std::size_t number);

// What a hand on the mouse sets: where a free eye is about the car, and how much a map shows.
struct Aim {
  double azimuth_rad = 0.7;    // of the eye from behind the car, positive over its right side
  double elevation_rad = 0.3;  // of the eye over the car
  double distance_m = 9.0;
  double map_height_m = 80.0;

  // Elevations are held in [-5, 85] degrees, the distance in [2.5, 400] m, the map in [8, 5000] m.
  void Turn(double azimuth_rad, double elevation_rad);
  void Zoom(double factor);  // above 1: farther
};

// A flat screen in a laboratory, as its eye sees it: a rectangle square to a level direction.
struct ScreenPlane {
  double width_m = 0.6, height_m = 0.34;
  double distance_m = 0.7;     // of the eye from its plane
  double angle_rad = 0.0;      // of that direction from straight ahead, positive to the left
  double eye_height_m = 0.17;  // of the eye over the screen's lower edge
  double aside_m = 0.0;        // of the screen's middle from the foot of the eye's distance, positive to the right
};

// The driver's eye, in B: 1.2 m high, below the roof of a lower car; higher in a lorry or a bus, and at its front.
Eigen::Vector3d DriversEye_B(const Body& car);
// Behind and above the car, without its roll. `others`: what stands in the way of the eye, as a lorry does that is
// close behind, has it come nearer, to before its front; evenly, as they come and go.
Camera ChaseCamera(const Body& car, const road::World& world, std::span<const Body> others = {});
// In the driver's seat, on the left.
Camera DriverCamera(const Body& car);
// From the driver's eye through a screen: what is seen there lies where it would be without the screen.
Camera ScreenCamera(const Body& car, const ScreenPlane& screen);
// In the middle, before the windscreen: the bonnet is the lower edge of the picture.
Camera BonnetCamera(const Body& car);
// About the car, without its roll and pitch, above the ground.
Camera OrbitCamera(const Body& car, const Aim& aim, const road::World& world);
// From above, north up, parallel rays.
Camera TopCamera(const Body& car, const Aim& aim);
// From posts beside the road, 120 m apart and left and right in turn, each for the part of the road around it; where no
// road is near, from posts on a lattice. The picture is as wide as the car needs.
Camera TracksideCamera(const Body& car, const road::World& world);
// The camera of a kind; `aim` counts for the orbit and the top, `world` for the chase, the orbit and the trackside,
// `others` for the chase.
Camera MakeCamera(CameraKind kind, const Body& car, const Aim& aim, const road::World& world,
                  std::span<const Body> others = {});
// The camera with one of the moment's bodies, among all others of it; nothing where there is none of that number.
std::optional<Camera> MakeCamera(CameraKind kind, const SceneSnapshot& moment, std::size_t number, const Aim& aim,
                                 const road::World& world);

}  // namespace rodeira::scene

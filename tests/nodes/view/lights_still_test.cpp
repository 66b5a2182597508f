// SPDX-License-Identifier: Apache-2.0
// Lamps, kinds of vehicles and people, asked of single pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/view/scene/vehicles/car_mesh.hpp"
#include "common/view/scene/vehicles/person_mesh.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 640, kHeight = 480;

// One vehicle of the traffic on the plane, looked at from behind or before.
class LightsStill : public DriverStill {
 protected:
  LightsStill() : DriverStill("plane.yaml", kWidth, kHeight) {}

  void Stand(scene::AgentKind kind, double length_m, double width_m, double height_m) {
    scene::AgentPose agent;
    agent.kind = kind;
    agent.p_WB_W = {12.0, 7.0, 0.0};
    agent.q_WB = scene::Attitude(0.6, 0.0, 0.0);
    agent.length_m = length_m;
    agent.width_m = width_m;
    agent.height_m = height_m;
    agent.wheelbase_m = 0.62 * length_m;
    picture_.moment.cars.clear();
    picture_.moment.agents = {agent};
    picture_.camera = scene::CameraKind::kOrbit;
    picture_.aim.elevation_rad = 0.12;
    picture_.aim.distance_m = 4.0 + 0.6 * length_m;
  }
  scene::AgentPose& Agent() { return picture_.moment.agents[0]; }
  // The middle of a lamp on one side, as it is built, in the picture.
  Probe LampIn(const Image& image, scene::Lamp lamp, bool front, double side) {
    const scene::CarMeshes car = scene::BuildVehicle(Agent().kind, scene::CarShape::Of(Agent()), {});
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < car.lamps.positions.size(); ++i) {
      const Eigen::Vector3d p = car.lamps.positions[i].cast<double>();
      if (car.lamps.on_face[i].x() == static_cast<float>(lamp) && (p.x() > 0.0) == front && p.y() * side > 0.0)
        box.extend(p);
    }
    EXPECT_FALSE(box.isEmpty());
    Eigen::Vector3d face = box.center();
    face.x() = front ? box.max().x() : box.min().x();
    return ProbeAt(image, renderer_->CameraOf(picture_), Agent().p_WB_W + Agent().q_WB * face, 1);
  }
  Image With(const scene::CarLights& lights, std::int64_t time_ns = 0) {
    Agent().lights = lights;
    picture_.moment.time_ns = time_ns;
    return Drawn();
  }
  void ExpectLampsShine();
};

void LightsStill::ExpectLampsShine() {
  using scene::Lamp;
  picture_.aim.azimuth_rad = 0.0;
  const Image dark = With({}), brakes = With({.brake = true}), left = With({.left = true}),
              right = With({.right = true}), reversing = With({.reversing = true});
  for (const double side : {1.0, -1.0}) {
    EXPECT_GT(LampIn(brakes, Lamp::kBrake, false, side).red, LampIn(dark, Lamp::kBrake, false, side).red + 50.0)
        << side;
    EXPECT_LT(LampIn(brakes, Lamp::kBrake, false, side).green, 90.0);
    EXPECT_GT(LampIn(reversing, Lamp::kReversing, false, side).blue,
              LampIn(dark, Lamp::kReversing, false, side).blue + 40.0)
        << side;
    const Lamp indicator = side > 0.0 ? Lamp::kLeft : Lamp::kRight;
    const Image &mine = side > 0.0 ? left : right, &other = side > 0.0 ? right : left;
    EXPECT_GT(LampIn(mine, indicator, false, side).green, LampIn(dark, indicator, false, side).green + 40.0) << side;
    EXPECT_NEAR(LampIn(other, indicator, false, side).green, LampIn(dark, indicator, false, side).green, 1.0) << side;
  }
  EXPECT_EQ(With({.left = true}, 400'000'000).rgb, With({}, 400'000'000).rgb) << "between two flashes";
  EXPECT_NE(With({.left = true}, 700'000'000).rgb, With({}, 700'000'000).rgb);
  picture_.aim.azimuth_rad = std::numbers::pi;
  const Image ahead = With({}), dipped = With({.dipped = true}), turning = With({.left = true, .right = true});
  for (const double side : {1.0, -1.0}) {
    EXPECT_GT(LampIn(dipped, Lamp::kHead, true, side).green, LampIn(ahead, Lamp::kHead, true, side).green + 10.0)
        << side;
    const Lamp indicator = side > 0.0 ? Lamp::kLeft : Lamp::kRight;
    EXPECT_GT(LampIn(turning, indicator, true, side).green, LampIn(ahead, indicator, true, side).green + 40.0) << side;
  }
}

TEST_F(LightsStill, OfACar) {
  Stand(scene::AgentKind::kCar, 4.0, 1.7, 1.45);
  ExpectLampsShine();
}
TEST_F(LightsStill, OfAVan) {
  Stand(scene::AgentKind::kVan, 5.3, 2.0, 2.1);
  ExpectLampsShine();
}
TEST_F(LightsStill, OfALorry) {
  Stand(scene::AgentKind::kLorry, 8.5, 2.5, 3.5);
  Agent().wheel_radius_m = 0.48;
  ExpectLampsShine();
}
TEST_F(LightsStill, OfABus) {
  Stand(scene::AgentKind::kBus, 11.5, 2.5, 3.1);
  Agent().wheel_radius_m = 0.48;
  ExpectLampsShine();
}

// Towards evening no car needs headlights yet; with them on the road ahead is brighter.
TEST_F(LightsStill, TheDriverSwitchesTheHeadlightsOn) {
  picture_.moment.weather.hour = 17.5;
  Car() = CarAt({12.0, 7.0, 0.0}, 0.6);
  const auto green_ahead = [&](const scene::CarLights& lights) {
    Car().lights = lights;
    return ProbeAt(Drawn(), scene::DriverCamera(Car()), Car().p_WB_W + Car().q_WB * Eigen::Vector3d(14.0, 0.0, 0.0), 2)
        .green;
  };
  const double without = green_ahead({});
  EXPECT_GT(green_ahead({.dipped = true}), without + 5.0);
  EXPECT_GT(green_ahead({.main = true}), without + 5.0);
  EXPECT_EQ(green_ahead({}), without);
}

// A pedestrian's legs part in a step and meet again where a step is done.
TEST_F(LightsStill, LegsMoveWithTheWayThatIsWalked) {
  Stand(scene::AgentKind::kPedestrian, 0.5, 0.5, 1.75);
  Agent().colour = scene::Colour::Of(0xd02020);
  Agent().wheel_radius_m = 0.2;
  picture_.aim.azimuth_rad = 0.5 * std::numbers::pi;
  picture_.aim.distance_m = 4.0;
  const auto walked = [&](double spin_rad) {
    Agent().wheel_spin_rad = spin_rad;
    return Drawn();
  };
  const Image standing = walked(0.0), stride = walked(0.5 * std::numbers::pi), other = walked(-0.5 * std::numbers::pi);
  EXPECT_EQ(walked(0.0).rgb, standing.rgb);
  const scene::Camera camera = renderer_->CameraOf(picture_);
  const auto at = [&](const Image& image, double ahead_m, double up_m) {
    return ProbeAt(image, camera, Agent().p_WB_W + Agent().q_WB * Eigen::Vector3d(ahead_m, 0.0, up_m), 1);
  };
  EXPECT_TRUE(at(standing, 0.0, 1.25).IsRed()) << at(standing, 0.0, 1.25);
  // Half a step before and behind are feet in a stride, and ground at a stand.
  for (const Image* image : {&stride, &other}) {
    for (const double side : {1.0, -1.0}) {
      EXPECT_LT(at(*image, side * 0.27, 0.12).green, at(standing, side * 0.27, 0.12).green - 25.0) << side;
    }
  }
  EXPECT_NE(stride.rgb, other.rgb) << "left is not right";
}

}  // namespace
}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
// A driver's car drives in eight ways among traffic, on a road of two lanes a direction, and in three where there is
// one; there it also drives on, and stands again, while it is passed. No vehicle drives into it or into another one,
// and none waits longer than a minute (for a gap in oncoming traffic 100 s) where there is a way on or round it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05, kBegins_s = 60.0, kFor_s = 300.0, kWaits_s = 60.0, kWaitsForGap_s = 100.0;
constexpr double kFree_m = 60.0, kCarLength_m = 4.4, kMoves_mps = 0.1, kShutIn_m = 7.0, kCutsIn_m = 10.0;
constexpr std::uint64_t kLeave = 90, kLeaveOneLane = 12;  // of some 130, and some 27, vehicles that come meanwhile
constexpr double kLength_m = 1600.0, kAt_m = 900.0, kLane_m = 3.5;
constexpr double kInner_y = -0.5 * kLane_m, kOuter_y = -1.5 * kLane_m, kOncoming_y = 0.5 * kLane_m;

// Along x; right-hand traffic.
std::shared_ptr<const network::Network> Road(int lanes) {
  const auto lane = [](int id) {
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/><roadMark "
        "sOffset=\"0\" type=\"broken\" color=\"white\" width=\"0.12\"/><speed sOffset=\"0\" max=\"16\" "
        "unit=\"m/s\"/></lane>",
        id, kLane_m);
  };
  opendrive::RoadText road;
  road.length = kLength_m;
  road.geometry =
      fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{}\"><line/></geometry>", kLength_m);
  road.left = (lanes == 2 ? lane(2) : "") + lane(1);
  road.right = lane(-1) + (lanes == 2 ? lane(-2) : "");
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

// The driver's car: where it is, and what it does with pedals and wheel.
struct Car {
  double x_m = kAt_m, y_m = kInner_y, heading_rad = 0.0, speed_mps = 0.0;
  double goes_from_s = -1e9;  // when it last drove on

  driver::Footprint At() const { return {9999, x_m, y_m, heading_rad, speed_mps, kCarLength_m, 1.8}; }
  void Drive(double desired_mps, double rate_mps2) {
    speed_mps += std::clamp(desired_mps - speed_mps, -rate_mps2 * kStep_s, rate_mps2 * kStep_s);
    x_m += std::cos(heading_rad) * speed_mps * kStep_s, y_m += std::sin(heading_rad) * speed_mps * kStep_s;
  }
  // Not into a vehicle beside it.
  void GoOver(double target_y_m, double rate_mps, const TrafficModel& model) {
    for (const AgentPose& pose : model.poses()) {
      if (std::fabs(pose.p_WB_W.x() - x_m) < kCutsIn_m && std::fabs(pose.p_WB_W.y() - target_y_m) < 0.5 * kLane_m)
        return;
    }
    y_m += std::clamp(target_y_m - y_m, -rate_mps * kStep_s, rate_mps * kStep_s);
  }
};

// From its front, or its rear, to the next vehicle in its way, within half a lane.
double Room(const Car& car, const TrafficModel& model, bool behind = false) {
  const double heading = car.heading_rad + (behind ? std::numbers::pi : 0.0);
  double room = 1e9;
  for (const AgentPose& pose : model.poses()) {
    const double ahead = (pose.p_WB_W.x() - car.x_m) * std::cos(heading);
    if (ahead > 0.0 && std::fabs(pose.p_WB_W.y() - car.y_m) < 0.6 * kLane_m)
      room = std::min(room, ahead - 0.5 * kCarLength_m - 0.5 * model.traits(pose.id).length_m);
  }
  return room;
}

struct Way {
  const char* name;
  Car begins;
  void (*drives)(Car& car, double t_s, const TrafficModel& model);
};

const Way kWays[] = {
    {"StandsAcrossLanes", {kAt_m, -0.6, 0.5 * std::numbers::pi, 0.0}, [](Car&, double, const TrafficModel&) {}},
    {"StandsInItsLane", {kAt_m, kOuter_y, 0.0, 0.0}, [](Car&, double, const TrafficModel&) {}},
    {"Reverses",
     {kAt_m, kOuter_y, 0.0, 0.0},
     [](Car& car, double t_s, const TrafficModel& model) {
       car.Drive(t_s < 10.0 || t_s > 40.0 || Room(car, model, true) < 5.0 ? 0.0 : -2.0, 2.0);
     }},
    {"DrivesOnTheWrongSide",
     {kAt_m, kOncoming_y, 0.0, 5.0},
     [](Car& car, double, const TrafficModel& model) { car.Drive(Room(car, model) < 15.0 ? 0.0 : 5.0, 4.0); }},
    {"DrivesOnTheVerge",
     {500.0, -2.0 * kLane_m - 0.5, 0.0, 3.0},
     [](Car& car, double, const TrafficModel&) { car.Drive(3.0, 1.0); }},
    {"Tailgates",
     {500.0, kOuter_y, 0.0, 10.0},
     [](Car& car, double, const TrafficModel& model) {
       const double room = Room(car, model);
       car.Drive(room < 3.0 ? 0.0 : room < 30.0 ? 18.0 : 14.0, room < 3.0 ? 7.0 : 2.0);
     }},
    {"BrakesHard",
     {500.0, kOuter_y, 0.0, 14.0},
     [](Car& car, double t_s, const TrafficModel& model) {
       const bool stops = std::fmod(t_s, 30.0) > 15.0 || Room(car, model) < 10.0;
       car.Drive(stops ? 0.0 : 14.0, stops ? 7.0 : 2.0);
     }},
    {"CutsIn",
     {500.0, kOuter_y, 0.0, 12.0},
     [](Car& car, double t_s, const TrafficModel& model) {
       car.Drive(Room(car, model) < 15.0 ? 4.0 : 12.0, 4.0);
       car.GoOver(std::fmod(t_s, 20.0) < 10.0 ? kOuter_y : kInner_y, 1.5, model);
     }},
};

// Where there is one lane a direction it has to be passed on that of oncoming traffic, in a gap of some 20 s.
const Way kWaysOnOneLane[] = {
    {"StandsInItsLane", {kAt_m, kInner_y, 0.0, 0.0}, [](Car&, double, const TrafficModel&) {}},
    {"StandsHalfOnTheVerge", {kAt_m, -kLane_m, 0.1, 0.0}, [](Car&, double, const TrafficModel&) {}},
    {"DrivesSlowly",
     {500.0, kInner_y, 0.0, 4.0},
     [](Car& car, double, const TrafficModel& model) { car.Drive(Room(car, model) < 8.0 ? 0.0 : 4.0, 4.0); }},
};

// Stands, drives on when the middle of a vehicle that passes it has come so near behind its own, and stops again after
// so long.
template <int kNear_m, int kGoes_s>
void StandsAgain(Car& car, double t_s, const TrafficModel& model) {
  constexpr double kOut_m = 0.5, kStep_m = 4.0, kDesired_mps = 4.0, kStandsFor_s = 8.0;
  for (const AgentPose& pose : model.poses()) {
    const double behind = car.x_m - pose.p_WB_W.x(), aside = pose.p_WB_W.y() - kInner_y;
    if (behind > kNear_m - kStep_m && behind < kNear_m && aside > kOut_m &&
        (pose.q_WB * Eigen::Vector3d::UnitX()).x() > 0.0 && t_s > car.goes_from_s + kGoes_s + kStandsFor_s)
      car.goes_from_s = t_s;
  }
  car.Drive(t_s > car.goes_from_s + kGoes_s || Room(car, model) < 8.0 ? 0.0 : kDesired_mps, 4.0);
}

const Way kWaysOfStandingAgain[] = {
    {"HalfOutFor1s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<12, 1>},
    {"HalfOutFor2s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<12, 2>},
    {"HalfOutFor4s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<12, 4>},
    {"HalfOutFor8s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<12, 8>},
    {"BehindFor2s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<7, 2>},
    {"BehindFor5s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<7, 5>},
    {"BesideFor1s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<1, 1>},
    {"BesideFor3s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<1, 3>},
    {"BesideFor8s", {kAt_m, kInner_y, 0.0, 0.0}, StandsAgain<1, 8>},
};

TrafficSettings Demand(std::uint64_t seed, int lanes) {
  std::string flows = "flows:\n";
  for (const int lane : {-2, -1, 1, 2}) {
    const int per_h = lanes == 2 ? 400 : lane < 0 ? 200 : 120;
    if (std::abs(lane) <= lanes) flows += fmt::format("  - {{lane: \"1:{}\", vehicles_per_h: {}}}\n", lane, per_h);
  }
  TrafficSettings settings = Settings(flows, seed);
  settings.vehicles = TrafficSettings::kMaxOfFlows;
  return settings;
}

// What is seen of the vehicles' positions alone.
class Watch {
 public:
  int contacts = 0;
  double longest_wait_s = 0.0;  // of a vehicle that may go on, or round

  void Observe(const TrafficModel& model, const Car* car, double t_s) {
    const auto& poses = model.poses();
    std::vector<driver::Footprint> bodies;
    for (const AgentPose& pose : poses) bodies.push_back(FootprintOf(pose, model.traits(pose.id)));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Seen& seen = seen_.try_emplace({poses[i].id, poses[i].trip}, Seen{poses[i].p_WB_W, t_s}).first->second;
      const bool moved = (poses[i].p_WB_W - seen.p_W).norm() > kMoves_mps * kStep_s;
      seen.p_W = poses[i].p_WB_W;
      if (moved || (car != nullptr && IsShutIn(bodies, i, *car))) seen.since_s = t_s;
      longest_wait_s = std::max(longest_wait_s, t_s - seen.since_s);
      // A car that drives into a vehicle at rest, or from behind, cannot be avoided.
      if (car != nullptr && moved && DistanceAhead(bodies[i], car->At()) > 0.0)
        contacts += driver::Overlap(bodies[i], car->At()) ? 1 : 0;
      for (std::size_t k = i + 1; k < bodies.size(); ++k) contacts += driver::Overlap(bodies[i], bodies[k]) ? 1 : 0;
    }
  }

 private:
  struct Seen {
    Eigen::Vector3d p_W;
    double since_s = 0.0;
  };

  static double DistanceAhead(const driver::Footprint& one, const driver::Footprint& other) {
    return (other.x_m - one.x_m) * std::cos(one.heading_rad);
  }
  // The driver's car is the next body on its lane, and so near that no path with the radius of a car leads round it.
  static bool IsShutIn(const std::vector<driver::Footprint>& bodies, std::size_t i, const Car& car) {
    const driver::Footprint &own = bodies[i], other = car.At();
    const double reach = 0.5 * (std::fabs(std::cos(other.heading_rad)) * other.length_m +
                                std::fabs(std::sin(other.heading_rad)) * other.width_m);
    const double room = DistanceAhead(own, other) - reach - 0.5 * own.length_m;
    return room > 0.0 && room < kShutIn_m && std::fabs(own.y_m - other.y_m) < kLane_m &&
           std::none_of(bodies.begin(), bodies.end(), [&](const driver::Footprint& between) {
             return &between != &own && DistanceAhead(own, between) > 0.0 && DistanceAhead(between, other) > 0.0 &&
                    std::fabs(own.y_m - between.y_m) < 0.5 * kLane_m;
           });
  }

  std::map<std::pair<std::uint32_t, std::uint32_t>, Seen> seen_;
};

// Until nothing is near the place where the driver's car begins.
void WaitForRoom(TrafficModel& model, const Car& car) {
  for (int i = 0; i < 4000; ++i) {
    const bool near = std::any_of(model.poses().begin(), model.poses().end(), [&](const AgentPose& pose) {
      return std::fabs(pose.p_WB_W.x() - car.x_m) < kFree_m;
    });
    if (!near) return;
    model.Step(kStep_s, {});
  }
}

void DriveAmongTraffic(const Way& way, int lanes, std::uint64_t leave, double waits_s) {
  const auto network = Road(lanes);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    TrafficModel model = TrafficModel::Make(Demand(seed, lanes), network, {}).value();
    for (double t = 0.0; t < kBegins_s; t += kStep_s) model.Step(kStep_s, {});
    Car car = way.begins;
    WaitForRoom(model, car);
    Watch watch;
    const std::uint64_t ended = model.ended();
    for (double t = 0.0; t < kFor_s; t += kStep_s) {
      const bool there = car.x_m < kLength_m - 20.0;
      std::vector<driver::Footprint> others;
      if (there) others.push_back(car.At()), way.drives(car, t, model);
      model.Step(kStep_s, others);
      watch.Observe(model, there ? &car : nullptr, t);
    }
    EXPECT_EQ(watch.contacts, 0) << seed;
    EXPECT_LT(watch.longest_wait_s, waits_s) << seed;
    EXPECT_GT(model.ended() - ended, leave) << seed;
  }
}

std::string NameOf(const ::testing::TestParamInfo<Way>& way) { return way.param.name; }

class DriversCar : public ::testing::TestWithParam<Way> {};
TEST_P(DriversCar, IsAvoidedAndPassed) { DriveAmongTraffic(GetParam(), 2, kLeave, kWaits_s); }
INSTANTIATE_TEST_SUITE_P(Ways, DriversCar, ::testing::ValuesIn(kWays), NameOf);

class DriversCarOnOneLane : public ::testing::TestWithParam<Way> {};
TEST_P(DriversCarOnOneLane, IsAvoidedAndPassed) { DriveAmongTraffic(GetParam(), 1, kLeaveOneLane, kWaitsForGap_s); }
INSTANTIATE_TEST_SUITE_P(Ways, DriversCarOnOneLane, ::testing::ValuesIn(kWaysOnOneLane), NameOf);
INSTANTIATE_TEST_SUITE_P(StandsAgain, DriversCarOnOneLane, ::testing::ValuesIn(kWaysOfStandingAgain), NameOf);

}  // namespace
}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motors/motors_driving.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/traffic/motors/motors_looks.hpp"
#include "common/traffic/perception/each_driving.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

using Eigen::Vector2d;

// Purposes of draws; never renumber.
enum MotorsDraw : std::uint64_t { kDrawResponsiveness = 301, kDrawAggression = 302, kDrawWeight = 303 };

constexpr double kLeftmost =
    0.65;  // the weights are drawn between this and what is left of 1; the source states no range
constexpr double kLookAhead_s = 2.0;
constexpr double kSlowest = 0.9;     // of the idle speed: there the clutch is closed …
constexpr double kAboveStall = 1.2;  // … and here open

double AngleBetween(const Vector2d& from, const Vector2d& to) {
  return std::atan2(geometry::Cross(from, to), from.dot(to));
}

}  // namespace

void MotorsDriving::StartMotors() {
  for (std::uint32_t id = 0; id < in_.agents.size(); ++id) {
    out_.motors.emplace_back(base::RandomUniform({in_.settings.seed, id, kDrawResponsiveness}, 0.5, 1.0),
                             base::RandomUniform({in_.settings.seed, id, kDrawAggression}, 3.0, 4.0));
  }
  out_.segments.resize(in_.agents.size());
}

Vector2d MotorsDriving::MotorsPoint(const MotorsDriver& driver, std::uint32_t index) const {
  const lanes::Curve& curve = in_.map.graph[driver.track].curve;
  const double d = std::min(index * kCheckpoint_m, curve.length_m()), left = 1.0 - d / curve.length_m();
  const lanes::CurvePoint at = curve.At(d);
  return at.p_W.head<2>() + (driver.weight - 0.5) * curve.WidthAt(d) * at.left_W() + left * left * left * driver.join_W;
}

// At least three.
std::uint32_t MotorsDriving::MotorsPoints(const MotorsDriver& driver) const {
  return std::max(3u,
                  static_cast<std::uint32_t>(std::ceil(in_.map.graph[driver.track].length_m() / kCheckpoint_m)) + 1);
}

// Onto the trajectory of a lane, from its own target on halfway to where that begins.
void MotorsDriving::TakeLane(std::uint32_t id, const Piece& piece) {
  MotorsDriver& driver = out_.motors[id];
  const bool onward = driver.lanes > 0;
  const Vector2d target = onward ? MotorsPoint(driver, MotorsPoints(driver) - 1) : Vector2d::Zero();
  driver.track = piece.track;
  driver.zero_m = piece.zero_m;
  driver.weight = base::RandomUniform({in_.settings.seed, id, kDrawWeight, driver.trip, driver.lanes++},
                                      1.0 - kLeftmost, kLeftmost);
  driver.join_W.setZero();
  driver.checkpoint = 0;
  if (onward) driver.join_W = 0.5 * (target - MotorsPoint(driver, 0));
}

// To the checkpoint that it comes to: one that is reached, or farther than the next, is passed; at the last one the
// next lane begins.
void MotorsDriving::FollowTrajectory(std::uint32_t id) {
  const Agent& agent = in_.agents[id];
  MotorsDriver& driver = out_.motors[id];
  const Vector2d at = out_.full->cars().p_WB_W(id).head<2>();
  if (driver.lanes == 0 || driver.trip != agent.trip) {
    driver.Begin(out_.full->cars().car(id).powertrain.gear());
    driver.trip = agent.trip;
    std::size_t i = agent.path.size() - 1;
    while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
    TakeLane(id, agent.path[i]);
    driver.checkpoint = std::min(static_cast<std::uint32_t>(std::max(0.0, (agent.o_m - driver.zero_m) / kCheckpoint_m)),
                                 MotorsPoints(driver) - 2);
  }
  while (true) {
    const std::uint32_t last = MotorsPoints(driver) - 1;
    while (driver.checkpoint < last) {
      const double here = (MotorsPoint(driver, driver.checkpoint) - at).norm(),
                   next = (MotorsPoint(driver, driver.checkpoint + 1) - at).norm();
      if (here < next && next >= kReached_m) break;
      ++driver.checkpoint;
    }
    if (driver.checkpoint < last) return;
    const auto own = std::find_if(agent.path.begin(), agent.path.end(), [&](const Piece& piece) {
      return piece.track == driver.track && piece.zero_m == driver.zero_m;
    });
    const auto next = own == agent.path.end() ? agent.path.begin() : own + 1;
    if (next == agent.path.end()) {  // the lane's traffic leaves here
      driver.checkpoint = last - 1;
      return;
    }
    TakeLane(id, *next);
  }
}

Vector2d MotorsDriving::MotorsLooksAt(std::uint32_t id) const {
  const MotorsDriver& driver = out_.motors[id];
  const auto ahead =
      driver.checkpoint + static_cast<std::uint32_t>(kLookAhead_s * in_.agents[id].speed_mps / kCheckpoint_m);
  return MotorsPoint(driver, std::min(ahead, MotorsPoints(driver) - 2));
}

// At the end of its lane the point lies beside the car, or behind, and says nothing.
double MotorsDriving::MotorsTurn_rad(std::uint32_t id, const Vector2d& look_W) const {
  const Vector2d to_W = look_W - out_.full->cars().p_WB_W(id).head<2>();
  return to_W.norm() < 2.0 * kCheckpoint_m
             ? 0.0
             : AngleBetween((out_.full->cars().car(id).body.q_WG * Eigen::Vector3d::UnitX()).head<2>(), to_W);
}

void MotorsDriving::GiveWay() {
  EachDriving(in_.pool, in_.agents, [&](std::uint32_t id) {
    FollowTrajectory(id);
    out_.motors[id].stops = false;
    out_.segments[id] = MotorsLooksAt(id);
  });
  std::vector<MotorsLook> all;
  for (std::uint32_t id = 0; id < in_.agents.size(); ++id) {
    if (!in_.agents[id].on_road) continue;
    const Eigen::Vector3d at = out_.full->cars().p_WB_W(id);
    all.push_back({at.head<2>(), out_.segments[id], at.z(), id});
  }
  const auto yields = [&](const MotorsLook& me, const MotorsLook& other) {
    const double side = geometry::Cross(me.to - me.from, other.from - me.from);
    MotorsDriver& driver = out_.motors[me.id];
    driver.stops = driver.stops || (in_.map.graph[driver.track].left_hand ? side >= 0.0 : side <= 0.0);
  };
  EachCrossing(all, [&](const MotorsLook& a, const MotorsLook& b) {
    yields(a, b);
    yields(b, a);
  });
}

void MotorsDriving::DriveMotors(std::uint32_t id, double dt_s) {
  MotorsDriver& driver = out_.motors[id];
  const Agent& agent = in_.agents[id];
  const dynamics::BicycleCar& car = out_.full->cars().car(id);
  const dynamics::BicycleSettings& settings = out_.full->cars().chassis(id).settings;
  const Vector2d at = out_.full->cars().p_WB_W(id).head<2>(),
                 ahead = (car.body.q_WG * Eigen::Vector3d::UnitX()).head<2>();
  const Vector2d current = MotorsPoint(driver, driver.checkpoint), target = MotorsPoint(driver, driver.checkpoint + 1);
  MotorsView view;
  view.speed_mps = agent.speed_mps;
  view.to_path_rad = AngleBetween(ahead, target - current);
  view.to_target_rad = AngleBetween(ahead, target - at);
  view.distance_m = (current - at).norm();
  view.turn_rad = MotorsTurn_rad(id, out_.segments[id]);
  view.limit_mps = std::min(kMotorsLimit_mps, Cap_mps(in_.agents[id], in_.traits[id]));
  view.stops = driver.stops || agent.brake_mps2 > 0.0;
  view.engine_radps = car.powertrain.engine().speed_radps();
  view.engine_runs = car.powertrain.engine().running();
  const dynamics::EngineSettings& engine = settings.powertrain.engine;
  MotorsCar of;
  of.steering_ratio = settings.steering.ratio;
  of.most_steer_rad = settings.steering.limit_rad / settings.steering.ratio;
  of.stall_radps = engine.idle_radps;
  of.bite_radps = kAboveStall * engine.stall_radps;
  of.closed_radps = kSlowest * engine.idle_radps;
  of.gears = static_cast<int>(settings.powertrain.gearbox.forward.size());
  out_.full->Hold(id, driver.Step(view, of, dt_s));
}

}  // namespace rodeira::traffic

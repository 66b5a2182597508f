// SPDX-License-Identifier: Apache-2.0
// Agents with the physics of the driver's car.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/results/study.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/common/traffic/curves.hpp"
#include "tests/common/traffic/duration.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.01;

TrafficSettings Full(std::uint32_t vehicles, unsigned threads = 1) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.physics = Physics::kFull;
  settings.threads = threads;
  return settings;
}

template <class Value>
base::Bytes BytesOf(const Value& value) {
  base::StateWriter writer;
  value.Save(writer);
  return writer.bytes();
}

// A car of the vehicle library at the same place, with the same pedals and steering wheel: the same bits, on slopes.
TEST(FullPhysics, ACarIsThatOfTheVehicleLibrary) {
  const auto network = lanes::MapNetwork("overpass");
  TrafficModel model = TrafficModel::Make(Full(30), network, {}).value();
  const auto ground = WorldOf(network)->MakeGround();
  std::vector<std::pair<std::uint32_t, dynamics::BicycleModel>> alone;
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    const double half = 0.5 * model.traits(pose.id).wheelbase_m;
    const Eigen::Vector3d front = FrameAt(model.graph(), agent.path, agent.o_m + half).p_W,
                          rear = FrameAt(model.graph(), agent.path, agent.o_m - half).p_W;
    const Eigen::Vector3d middle = 0.5 * (front + rear), along = front - rear;
    alone.emplace_back(pose.id, dynamics::BicycleModel(CarOfBody(model.traits(pose.id).body)));
    ASSERT_TRUE(alone.back()
                    .second
                    .Initialise({.x_m = middle.x(),
                                 .y_m = middle.y(),
                                 .z_hint_m = middle.z(),
                                 .heading_rad = std::atan2(along.y(), along.x()),
                                 .speed_mps = agent.speed_mps * along.norm() / along.head<2>().norm()},
                                *ground)
                    .ok());
  }
  std::size_t compared = 0, steepest = 0;
  for (int i = 0; i < 1000; ++i) {
    model.Step(kStep_s, {});
    for (auto& [id, car] : alone) {
      if (!model.agent(id).on_road || model.agent(id).trip != 0) continue;
      car.Step(model.full()->controls(id), *ground, kStep_s);
      ASSERT_EQ(BytesOf(model.full()->cars().car(id)), BytesOf(car.car())) << "car " << id << " at step " << i;
      ++compared;
      if (std::fabs(model.agent(id).grade) > 0.02) ++steepest;
    }
  }
  EXPECT_GT(compared, 15000u);
  EXPECT_GT(steepest, 100u);
}

TEST(FullPhysics, ThreadsChangeNoBit) {
  const auto network = lanes::MapNetwork("town");
  TrafficModel one = TrafficModel::Make(Full(40), network, {}).value(),
               two = TrafficModel::Make(Full(40, 2), network, {}).value(),
               four = TrafficModel::Make(Full(40, 4), network, {}).value();
  for (int i = 0; i < 500; ++i) {
    for (TrafficModel* model : {&one, &two, &four}) model->Step(kStep_s, {});
  }
  EXPECT_EQ(BytesOf(one), BytesOf(two));
  EXPECT_EQ(BytesOf(one), BytesOf(four));
}

TEST(FullPhysics, RestoredItGoesOnWithTheSameBits) {
  const auto network = lanes::MapNetwork("roundabout");
  TrafficModel first = TrafficModel::Make(Full(40), network, {}).value(),
               second = TrafficModel::Make(Full(40), network, {}).value();
  for (int i = 0; i < 1500; ++i) first.Step(kStep_s, {});
  const base::Bytes snapshot = BytesOf(first);
  base::StateReader reader(snapshot);
  second.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int i = 0; i < 1000; ++i) {
    first.Step(kStep_s, {});
    second.Step(kStep_s, {});
  }
  EXPECT_EQ(BytesOf(first), BytesOf(second));
}

// Through pedals, engine and tyres the gap of the IDM's equilibrium, (s0 + v T) / sqrt(1 - (v/v0)^4), behind a car of
// constant speed.
TEST(FullPhysics, KeepsTheEquilibriumGapWithin5Centimetres) {
  PlotCurve measured{"measured: engine, clutch, gears, brakes, tyres", "#b03020", {}, false},
      theory{"(s0 + v T) / sqrt(1 - (v/v0)^4)", "#1f5f8b", {}, true};
  for (const double speed_mps : {5.0, 9.0, 13.0}) {
    TrafficSettings settings = Identical(10, 1.3);
    settings.physics = Physics::kFull;
    TrafficModel model = TrafficModel::Make(settings, Ring(600.0), {}).value();
    ASSERT_EQ(model.on_road(), 10u);
    model.CapSpeed(0, speed_mps);  // the leader of the nine others
    for (int i = 0; i < (speed_mps > 10.0 ? BriefOrLong(30000, 50000) : BriefOrLong(10000, 15000)); ++i)
      model.Step(kStep_s, {});  // near the limit the follower comes up slowly
    int compared = 0;
    for (std::uint32_t id = 1; id < 10; ++id) {
      if (model.GapAhead(id) > 40.0) continue;
      EXPECT_NEAR(model.agent(id).speed_mps, model.agent(0).speed_mps, 0.02) << id << " at " << speed_mps;
      EXPECT_NEAR(model.GapAhead(id),
                  driver::IdmEquilibriumGap(settings.idm, model.agent(id).speed_mps, kRingLimit_mps), 0.05)
          << id << " at " << speed_mps;
      measured.points.emplace_back(model.agent(id).speed_mps, model.GapAhead(id));
      ++compared;
    }
    EXPECT_GE(compared, 7) << speed_mps;
  }
  for (double v = 0.0; v <= 14.0; v += 0.1)
    theory.points.emplace_back(v, driver::IdmEquilibriumGap(Identical(10, 1.3).idm, v, kRingLimit_mps));
  EXPECT_TRUE(WritePicture("traffic_gap.svg", PlotSvg("How far behind one another, through the powertrain",
                                                      "speed, m/s", "gap, m", 2.0, 5.0, {measured, theory})));
}

// The same uphill and downhill, two cars one behind the other.
TEST(FullPhysics, KeepsTheEquilibriumGapOnAGrade) {
  constexpr double kLimit_mps = 16.0;
  for (const double grade : {0.04, -0.04}) {
    for (const double speed_mps : {5.0, 9.0, 13.0}) {
      TrafficSettings settings = Identical(0, 1.3);
      settings.physics = Physics::kFull;
      settings.scripted = {VehicleKind::kCar, VehicleKind::kCar};
      settings.overtaking.allowed = false;
      TrafficModel model = TrafficModel::Make(settings, driver::StraightWorld(3000.0, kLimit_mps, grade), {}).value();
      model.CapSpeed(0, speed_mps);
      ASSERT_TRUE(model.Spawn(0, "test:-1", 60.0, speed_mps).value());
      ASSERT_TRUE(model.Spawn(1, "test:-1", 25.0, speed_mps).value());
      // Near the limit the follower comes up slowly.
      for (int i = 0; i < (speed_mps > 10.0 ? 18000 : BriefOrLong(9000, 18000)); ++i) model.Step(kStep_s, {});
      ASSERT_EQ(model.on_road(), 2u);
      EXPECT_NEAR(model.agent(0).grade, grade, 5e-3);  // the car pitches a little
      EXPECT_NEAR(model.agent(1).speed_mps, model.agent(0).speed_mps, 0.02) << grade << " at " << speed_mps;
      EXPECT_NEAR(model.GapAhead(1), driver::IdmEquilibriumGap(settings.idm, model.agent(1).speed_mps, kLimit_mps),
                  0.05)
          << grade << " at " << speed_mps;
    }
  }
}

// What leaves a car's tank is the integral of the flow that its engine tells of, millisecond by millisecond, of a car
// of the vehicle library that is driven alone by the same pedals and has the same bits; in overrun nothing flows.
TEST(FullPhysics, TheTankLosesTheIntegralOfTheFlow) {
  constexpr double kSubstep_s = 1e-3;
  const auto network = lanes::MapNetwork("crossing");
  TrafficModel model = TrafficModel::Make(Full(12), network, {}).value();
  const auto ground = WorldOf(network)->MakeGround();
  struct Alone {
    std::uint32_t id;
    dynamics::BicycleModel car;
    double burnt_kg = 0.0;
  };
  std::vector<Alone> alone;
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    const double half = 0.5 * model.traits(pose.id).wheelbase_m;
    const Eigen::Vector3d front = FrameAt(model.graph(), agent.path, agent.o_m + half).p_W,
                          rear = FrameAt(model.graph(), agent.path, agent.o_m - half).p_W;
    const Eigen::Vector3d middle = 0.5 * (front + rear), along = front - rear;
    alone.push_back({pose.id, dynamics::BicycleModel(CarOfBody(model.traits(pose.id).body))});
    ASSERT_TRUE(alone.back()
                    .car
                    .Initialise({.x_m = middle.x(),
                                 .y_m = middle.y(),
                                 .z_hint_m = middle.z(),
                                 .heading_rad = std::atan2(along.y(), along.x()),
                                 .speed_mps = agent.speed_mps * along.norm() / along.head<2>().norm()},
                                *ground)
                    .ok());
  }
  int compared = 0, overrun = 0, changed = 0;
  for (int i = 0; i < 1500; ++i) {
    model.Step(kStep_s, {});
    for (Alone& one : alone) {
      const Agent& agent = model.agent(one.id);
      if (!agent.on_road || agent.trip != 0) continue;
      const dynamics::Engine& engine = one.car.car().powertrain.engine();
      double first = -1.0;
      for (int k = 0; k < std::lround(kStep_s / kSubstep_s); ++k) {
        one.car.Step(model.full()->controls(one.id), *ground, kSubstep_s);
        one.burnt_kg += engine.fuel_rate_kgps() * kSubstep_s;
        if (first < 0.0) first = engine.fuel_rate_kgps();
        if (engine.throttle() > 0.0 || engine.speed_radps() < 130.0) continue;
        EXPECT_EQ(engine.fuel_rate_kgps(), 0.0);
        ++overrun;
      }
      changed += first != engine.fuel_rate_kgps() ? 1 : 0;
      ASSERT_NEAR(1e-6 * agent.fuel_mg, one.burnt_kg, 1e-9 * (1e-3 + one.burnt_kg))
          << "car " << one.id << " at step " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(overrun, 5000);
  EXPECT_GT(changed, 1000);  // the flow is not that of the step's end
}

// On a steep grade a car begins with the speed over the plan that it was given: the first step changes it by what
// pedals and slope can do.
TEST(FullPhysics, BeginsOnAGradeWithItsSpeedOverThePlan) {
  constexpr double kGrade = 0.2, kMost_mps2 = 3.0;  // weight along the slope: 1.9 m/s²
  TrafficModel model = TrafficModel::Make(Full(12), driver::StraightWorld(3000.0, 16.0, kGrade), {}).value();
  std::vector<double> before(model.vehicles());
  ASSERT_GT(model.poses().size(), 5u);
  for (const AgentPose& pose : model.poses()) {
    before[pose.id] = pose.speed_mps;
    ASSERT_GT(pose.speed_mps, 5.0);
    ASSERT_GT(std::fabs(model.agent(pose.id).grade), 0.75 * kGrade);
  }
  model.Step(kStep_s, {});
  for (const AgentPose& pose : model.poses())
    EXPECT_NEAR(pose.speed_mps, before[pose.id], kMost_mps2 * kStep_s) << "car " << pose.id;
}

// At a constant speed uphill the throttle is what weight, rolling and air ask of the engine through the gears.
TEST(FullPhysics, ClimbsWithTheThrottleOfTheClosedForm) {
  constexpr double kGrade = 0.05;
  TrafficModel model = TrafficModel::Make(Full(12), driver::StraightWorld(3000.0, 16.0, kGrade), {}).value();
  int compared = 0;
  for (int i = 0; i < 6000; ++i) {
    model.Step(kStep_s, {});
    if (i < 4000 || i % 100 != 0) continue;
    for (const AgentPose& pose : model.poses()) {
      const Agent& agent = model.agent(pose.id);
      const dynamics::BicycleCar& car = model.full()->cars().car(pose.id);
      if (agent.grade < 0.0 || std::fabs(agent.acceleration_mps2) > 2e-3 || agent.driving.clutch > 0.0) continue;
      const dynamics::BicycleSettings& of = CarOfBody(model.traits(pose.id).body);
      const double slope = std::atan(kGrade), v = agent.speed_mps / std::cos(slope);
      const double force_N =
          of.body.mass_kg * 9.81 * (std::sin(slope) + 0.012 * std::cos(slope)) + 0.5 * 1.2 * 0.5 * v * v;
      const double ratio =
          4.19 * std::array{3.46, 1.96, 1.39, 1.03, 0.85}[static_cast<std::size_t>(agent.driving.gear - 1)];
      const double torque_Nm = force_N * of.wheel.rolling_radius_m / (0.93 * ratio),
                   radps = car.powertrain.engine().speed_radps();
      const double full_Nm = dynamics::FullLoadTorque(of.powertrain.engine, radps),
                   drag_Nm = of.body.mass_kg / 1050.0 * (14.0 + 0.012 * radps);
      EXPECT_NEAR(car.powertrain.engine().throttle(), (torque_Nm + drag_Nm) / (full_Nm + drag_Nm), 0.01)
          << "car " << pose.id << " in gear " << agent.driving.gear;
      ++compared;
    }
  }
  EXPECT_GE(compared, 20);
}

// No vehicle touches another, leaves the lanes, drives in an emergency, or brakes harder than a driver does;
// stops are let go of by the planned jerk, though cars do not do exactly what they are asked.
TEST(FullPhysics, DrivesTheProjectsMaps) {
  for (const std::string& map : lanes::MapNames()) {
    for (std::uint64_t seed = 1; seed <= BriefOrLong(1u, 2u); ++seed) {
      StudySettings settings;
      settings.traffic = Full(24);
      settings.traffic.seed = seed;
      settings.duration_s = Duration(BriefOrLong(15.0, 40.0));
      const StudyResult r = RunStudy(settings, lanes::MapNetwork(map)).value();
      std::string what = fmt::format("{} seed {}", map, seed);
      RecordProperty(what, fmt::format("{:.2f} m/s² with a foot on the brake, {:.2f} asked by it, {:.1f} km",
                                       r.max_deceleration_mps2, r.foot_mps2, r.driven_km));
      for (const std::string& incident : r.incidents) what += "\n  " + incident;
      EXPECT_EQ(r.collisions, 0) << what;
      EXPECT_EQ(r.off_lane, 0) << what;
      EXPECT_EQ(r.wheels_off, 0) << what;
      EXPECT_EQ(r.hurried_steps, 0) << what;
      EXPECT_LT(r.worst_step_m, 1e-3) << what;
      EXPECT_LE(r.foot_mps2, 3.0) << what;
      EXPECT_LE(r.max_deceleration_mps2, 4.0) << what;
      EXPECT_GT(r.driven_km, 1.0) << what;
    }
  }
}

// Lorries and buses among cars touch no other, keep to their lanes with their middle, and drive in no emergency. Bends
// of these maps are too tight for them: a lane of 3.25 m that bends by 10 m has room for the wheels of a car, not of a
// bus, with tracks of its front and rear axles 1.5 m apart there. So their wheels leave a lane, by 0.75 m at most (0.67
// measured, behind a roundabout's opposite bends), and only there; no other's do.
TEST(FullPhysics, LongBodiesDriveTheProjectsMaps) {
  for (const std::string& map : lanes::MapNames()) {
    const auto network = lanes::MapNetwork(map);
    StudySettings settings;
    settings.traffic = Full(24);
    settings.traffic.seed = map == "town" ? 2 : 1;
    settings.traffic.mix.shares = {0.6, 0.1, 0.2, 0.1};
    settings.duration_s = Duration(BriefOrLong(20.0, 50.0));
    double off_m = 0.0;
    int off = 0;
    network::Hint hint;
    const StudyResult r =
        RunStudy(settings, network, [&](const StudyMoment& moment) {
          for (const AgentPose& pose : moment.model.poses()) {
            const AgentTraits& traits = moment.model.traits(pose.id);
            const Agent& agent = moment.model.agent(pose.id);
            for (const double along : {-0.5, 0.5}) {
              for (const double side : {-1.0, 1.0}) {
                const Eigen::Vector3d wheel_W =
                    pose.p_WB_W +
                    pose.q_WB * Eigen::Vector3d(along * traits.wheelbase_m, side * (0.5 * traits.width_m - 0.1), 0.0);
                const auto place = network->Locate(wheel_W.x(), wheel_W.y(), wheel_W.z(), &hint);
                if (place && place->distance_m <= 1e-3) continue;
                ++off;
                off_m = std::max(off_m, place ? place->distance_m : 1e3);
                EXPECT_TRUE(traits.kind == VehicleKind::kLorry || traits.kind == VehicleKind::kBus)
                    << map << ", car " << pose.id << " at " << moment.time_s << " s";
                double bends_1pm = 0.0;
                for (double at = -traits.length_m; at <= traits.length_m; at += 1.0)
                  bends_1pm =
                      std::max(bends_1pm, std::fabs(FrameAt(moment.model.graph(), agent.path,
                                                            std::max(agent.path.front().begin_m, agent.o_m + at))
                                                        .curvature_1pm));
                EXPECT_GT(bends_1pm, 1.0 / 16.0) << map << ", car " << pose.id << " at " << moment.time_s << " s";
              }
            }
          }
        }).value();
    RecordProperty(
        map, fmt::format(
                 "{:.2f} m/s² with a foot on the brake, {:.2f} asked by it, wheels {:.2f} m off in {} looks, {:.1f} km",
                 r.max_deceleration_mps2, r.foot_mps2, off_m, off, r.driven_km));
    std::string what = map;
    for (const std::string& incident : r.incidents) what += "\n  " + incident;
    EXPECT_EQ(r.collisions, 0) << what;
    EXPECT_EQ(r.off_lane, 0) << what;
    EXPECT_EQ(r.hurried_steps, 0) << what;
    EXPECT_LE(off_m, 0.75) << what;
    EXPECT_LE(r.foot_mps2, 4.0) << what;
    EXPECT_LE(r.max_deceleration_mps2, 4.5) << what;
    EXPECT_GT(r.driven_km, 1.0) << what;
  }
}

// While it brakes a car is within 0.4 m/s of the speed that its desired acceleration leads to, which changes by the
// planned jerk down to where the foot ends the stop.
TEST(FullPhysics, DesiredAccelerationChangesByThePlannedJerk) {
  TrafficModel model = TrafficModel::Make(Full(24), lanes::MapNetwork("crossing"), {}).value();
  std::vector<double> before(model.vehicles()), lags;
  std::vector<std::uint32_t> trips(model.vehicles());
  int stops = 0;
  for (int i = 0; i < 4000; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const Agent& agent = model.agent(pose.id);
      const driver::Pedals& foot = model.full()->foot(pose.id);
      const double change = std::fabs(agent.desired_mps2 - std::exchange(before[pose.id], agent.desired_mps2));
      if (std::exchange(trips[pose.id], pose.trip) != pose.trip || i == 0) continue;
      if (foot.holds()) {
        EXPECT_GE(agent.desired_mps2, 0.0);
        stops += change > 0.0 ? 1 : 0;
        continue;
      }
      EXPECT_LE(change, 3.0 * kStep_s * (1.0 + 1e-6))
          << "car " << pose.id << " at " << i * kStep_s << " s, " << pose.speed_mps << " m/s";
      if (agent.desired_mps2 < -0.5) lags.push_back(std::fabs(foot.reference_mps() - pose.speed_mps));
    }
  }
  EXPECT_GT(stops, 10);
  ASSERT_FALSE(lags.empty());
  std::sort(lags.begin(), lags.end());
  EXPECT_LE(lags.back(), 0.4);
  EXPECT_LE(lags[lags.size() * 9 / 10], 0.2);  // while a gear changes it is more
}

}  // namespace
}  // namespace rodeira::traffic

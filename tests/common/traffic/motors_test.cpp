// SPDX-License-Identifier: Apache-2.0
// MOTORS' driver against the laws of its source: values worked out by hand from the printed code, and whole runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/motors/motors_driver.hpp"
#include "common/traffic/results/study.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRpm = 2.0 * std::numbers::pi / 60.0;

// A.59: s = 2 atan(2 (d/2)²)/pi: nothing at the checkpoint, a half where 2 (d/2)² = 1.
TEST(Motors, SteersBetweenThePathAndTheTarget) {
  EXPECT_EQ(TargetWeight(0.0), 0.0);
  EXPECT_NEAR(TargetWeight(std::sqrt(2.0)), 0.5, 1e-12);
  EXPECT_NEAR(TargetWeight(2.0), 2.0 * std::atan(2.0) / std::numbers::pi, 1e-12);
  EXPECT_NEAR(SteeringAngle(0.1, 0.3, 0.0, 0.6), 0.1, 1e-12);
  EXPECT_NEAR(SteeringAngle(0.1, 0.3, 1.0, 0.6), 0.2, 1e-12);
  EXPECT_NEAR(SteeringAngle(0.1, 0.3, 0.5, 0.6), 0.25 / 1.5, 1e-12);
  EXPECT_EQ(SteeringAngle(2.0, 2.0, 1.0, 0.6), 0.6);
  EXPECT_EQ(SteeringAngle(-2.0, -2.0, 1.0, 0.6), -0.6);
}

// A.41 and A.66, its weights the right way round; A.69, A.70.
TEST(Motors, PedalsAreTheSources) {
  for (const auto& [degrees, speed] :
       {std::pair{0.0, 17.0}, {10.0, 17.0}, {15.0, 14.5}, {20.0, 12.0}, {30.0, 8.5}, {40.0, 5.0}, {170.0, 5.0}}) {
    EXPECT_NEAR(TurningSpeed_mps(degrees * kDegree, 17.0), speed, 1e-9) << degrees;
    EXPECT_NEAR(TurningSpeed_mps(-degrees * kDegree, 17.0), speed, 1e-9) << degrees;
  }
  EXPECT_EQ(TurningSpeed_mps(15.0 * kDegree, 8.0), 8.0);
  EXPECT_EQ(MotorsThrottle(0.0), 0.5);
  EXPECT_NEAR(MotorsThrottle(10.0 * kDegree), 0.5 * std::pow(2.0, -0.06), 1e-12);
  EXPECT_NEAR(MotorsThrottle(-50.0 * kDegree), 0.5 * std::pow(2.0, -1.5), 1e-12);
  EXPECT_EQ(MotorsBrake(0.0, false), 0.0);
  EXPECT_NEAR(MotorsBrake(1.0, false), 0.5, 1e-12);
  EXPECT_NEAR(MotorsBrake(1.0, true), 0.6, 1e-12);
  EXPECT_EQ(MotorsBrake(1e6, true), 1.0);
}

// A.82 to A.84.
TEST(Motors, SegmentsCrossWhereTheEndsLieOnBothSides) {
  EXPECT_TRUE(SegmentsCross({0, 0}, {4, 0}, {2, -1}, {2, 1}));
  EXPECT_FALSE(SegmentsCross({0, 0}, {4, 0}, {5, -1}, {5, 1}));
  EXPECT_FALSE(SegmentsCross({0, 0}, {4, 0}, {2, 1}, {2, 3}));
  EXPECT_FALSE(SegmentsCross({0, 0}, {4, 0}, {0, 1}, {4, 1}));
}

// A.62 at 50 Hz: three degrees a frame are 150 a second, the last step cut to the target.
TEST(Motors, HandsHaveARate) {
  MotorsDriver driver(1.0, 3.0);
  MotorsView view;
  view.engine_radps = 1300.0 * kRpm;
  view.to_path_rad = view.to_target_rad = 10.0 * kDegree;
  for (int frame = 1; frame <= 5; ++frame) {
    (void)driver.Step(view, {}, 0.02);
    EXPECT_NEAR(driver.steer_rad(), std::min(3.0 * frame, 10.0) * kDegree, 1e-12) << frame;
  }
  MotorsDriver half(0.5, 4.0);
  for (int frame = 0; frame < 10; ++frame) (void)half.Step(view, {}, 0.02);
  EXPECT_NEAR(half.steer_rad(), 5.0 * kDegree, 1e-12);
}

// A.75 to A.81: a gear up at 1500 1/min, the clutch up by 0.08 a frame without throttle, the next one a hundred frames
// later.
TEST(Motors, GearsGoUpAndDownWithTheirPause) {
  MotorsDriver driver;
  driver.Begin(1);
  MotorsView view;
  view.engine_radps = 1600.0 * kRpm;
  view.limit_mps = 17.0;
  dynamics::Controls controls = driver.Step(view, {}, 0.02);
  EXPECT_EQ(controls.gear, 2);
  for (int frame = 1; frame <= 12; ++frame) {
    controls = driver.Step(view, {}, 0.02);
    EXPECT_NEAR(controls.clutch, 1.0 - 0.08 * frame, 1e-9) << frame;
    EXPECT_EQ(controls.throttle, 0.0) << frame;
  }
  controls = driver.Step(view, {}, 0.02);  // 13 · 0.08 > 1
  EXPECT_FALSE(driver.changes_gear());
  controls = driver.Step(view, {}, 0.02);
  EXPECT_EQ(controls.clutch, 0.0);
  EXPECT_GT(controls.throttle, 0.0);
  for (int frame = 15; frame < 100; ++frame) ASSERT_EQ(driver.Step(view, {}, 0.02).gear, 2) << frame;
  int frame = 100;
  while (driver.Step(view, {}, 0.02).gear == 2 && frame < 110) ++frame;
  EXPECT_LE(frame, 101);
  view.engine_radps = 1000.0 * kRpm;
  for (int more = 0; more < 101; ++more) controls = driver.Step(view, {}, 0.02);
  EXPECT_EQ(controls.gear, 2);
  view.engine_radps = 1300.0 * kRpm;
  for (int more = 0; more < 300; ++more) controls = driver.Step(view, {}, 0.02);
  EXPECT_EQ(controls.gear, 2);
  view.engine_radps = 6600.0 * kRpm;  // A.72 to A.74: until it is below 6300
  EXPECT_EQ(driver.Step(view, {}, 0.02).throttle, 0.0);
}

TrafficSettings AsMotors(std::uint32_t vehicles) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = 4;
  settings.driver = DriverKind::kMotors;
  settings.physics = Physics::kFull;
  return settings;
}

// Alone on a long straight road, where it begins slower: it comes to 17 m/s and no faster, whatever the lane's limit,
// within its lane.
TEST(Motors, DrivesAloneToItsLimit) {
  opendrive::RoadText road;
  road.length = 8000.0;
  road.left = "";
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"8000\"><line/></geometry>";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" "
      "max=\"10\" unit=\"m/s\"/></lane>";
  TrafficModel model =
      TrafficModel::Make(AsMotors(1), opendrive::MustRead(opendrive::Document(road.Text())), {}).value();
  double fastest = 0.0, aside = 0.0;
  int published = 0;
  for (int i = 0; i < 12000 && model.agent(0).trip == 0; ++i) {
    model.Step(0.01, {});
    if (model.poses().empty()) continue;
    fastest = std::max(fastest, model.poses()[0].speed_mps);
    aside = std::max(aside, std::fabs(model.poses()[0].p_WB_W.y() + 1.75));
    if (model.poses()[0].speed_mps < 16.0 || model.poses()[0].p_WB_W.x() > 7900.0) continue;
    const AgentDetail detail = model.Details()[0];  // published are this driver model's values, not the default one's
    ASSERT_NEAR(detail.target_mps, 17.0, 1e-9);
    const Eigen::Vector3d& at_W = model.poses()[0].p_WB_W;
    ASSERT_NEAR(detail.look_ahead_W.x() - at_W.x(), 2.0 * model.poses()[0].speed_mps, 1.0);
    // The point behind the nearest one of its trajectory, which has one every 0.3 m along the road, as it was before
    // the step's way.
    const double ahead_m = detail.target_W.x() - at_W.x() + 0.01 * model.poses()[0].speed_mps;
    ASSERT_TRUE(ahead_m > 0.14 && ahead_m < 0.46) << ahead_m;
    ASSERT_LT(std::fabs(detail.target_W.y() + 1.75), 0.15 * 3.5 + 1e-9);
    ASSERT_NEAR(detail.path_heading_rad, 0.0, 1e-9);
    ++published;
  }
  EXPECT_GT(fastest, 16.5);
  EXPECT_LT(fastest, 17.3);
  EXPECT_GT(published, 1000);
  EXPECT_LT(aside, 0.15 * 3.5 + 0.3);  // the weight's range, and what it is beside its trajectory
}

// On the maps MOTORS' driver drives through to the end and runs into vehicles that it does not see. The default driver
// runs into none (NetworkTraffic).
TEST(Motors, DrivesTheMapsAndItsCollisionsAreCounted) {
  std::int64_t collisions = 0;
  for (const char* name : {"crossing", "roundabout", "town"}) {
    StudySettings settings;
    settings.traffic = AsMotors(15);
    settings.duration_s = BriefOrLong(40.0, 60.0);
    const StudyResult r = RunStudy(settings, lanes::MapNetwork(name)).value();
    EXPECT_GT(r.arrivals, 3) << name;
    EXPECT_GT(r.mean_speed_mps(), 2.0) << name;
    EXPECT_EQ(r.on_road + r.waiting, 15u) << name;
    collisions += r.collisions;
    testing::Test::RecordProperty(
        name, fmt::format("{} collisions, {} trips, {:.1f} km, {:.1f} m/s, {} looks off lane", r.collisions, r.arrivals,
                          r.driven_km, r.mean_speed_mps(), r.off_lane));
    if (std::getenv("RODEIRA_TELL") != nullptr)
      fmt::print("{}: {} collisions, {} trips, {:.1f} km, {:.1f} m/s, {} looks off lane\n", name, r.collisions,
                 r.arrivals, r.driven_km, r.mean_speed_mps(), r.off_lane);
  }
  EXPECT_GT(collisions, 0);
}

// Speed goes on from step to step even where it has lost its car and slides sideways or turns about: by no more than
// what four tyres take of friction, and as fast as the direction turns along which it is told, heading and steering; it
// stays at 0 where the car goes backwards.
TEST(Motors, TheSpeedHasNoStepsInASlide) {
  constexpr double kStep_s = 0.01, kTyres_mps2 = 1.3 * 9.81;
  double fastest_aside_mps = 0.0, max_deceleration_mps2 = 0.0;
  for (const std::uint64_t seed : {1, 4}) {
    TrafficSettings settings = AsMotors(15);
    settings.seed = seed;
    TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
    struct Before {
      std::int64_t trip = -1;
      double speed_mps = 0.0, course_rad = 0.0;
    };
    std::vector<Before> before(model.vehicles());
    for (int i = 0; i < 6000; ++i) {
      model.Step(kStep_s, {});
      for (const AgentPose& pose : model.poses()) {
        const dynamics::RigidBody& body = model.full()->cars().car(pose.id).body;
        const Eigen::Vector2d v = body.VelocityAt(pose.p_WB_W).head<2>();
        const Eigen::Vector3d ahead = pose.q_WB * Eigen::Vector3d::UnitX();
        const double course = std::atan2(ahead.y(), ahead.x()) + std::atan(0.5 * std::tan(pose.steer_rad));
        Before& last = before[pose.id];
        if (last.trip == static_cast<std::int64_t>(pose.trip)) {
          const double turned = std::fabs(std::remainder(course - last.course_rad, 2.0 * std::numbers::pi));
          ASSERT_LE(std::fabs(pose.speed_mps - last.speed_mps), kTyres_mps2 * kStep_s + v.norm() * turned + 2e-3)
              << "car " << pose.id << " at " << kStep_s * i << " s";
          max_deceleration_mps2 = std::max(max_deceleration_mps2, -pose.acceleration_mps2);
        }
        last = {pose.trip, pose.speed_mps, course};
        fastest_aside_mps =
            std::max(fastest_aside_mps, std::fabs(v.dot(Eigen::Vector2d(-std::sin(course), std::cos(course)))));
        ASSERT_NEAR(pose.speed_mps, std::max(0.0, v.dot(Eigen::Vector2d(std::cos(course), std::sin(course)))), 2e-3);
      }
    }
  }
  EXPECT_GT(fastest_aside_mps, 3.0);  // a vehicle does slide
  if (std::getenv("RODEIRA_TELL") != nullptr)
    fmt::print("at most {:.2f} m/s aside, {:.1f} m/s2 slower\n", fastest_aside_mps, max_deceleration_mps2);
}

TEST(Motors, ThreadsAndSnapshotsChangeNoBit) {
  const auto network = lanes::MapNetwork("crossing");
  const auto digest = [](const TrafficModel& model) {
    base::StateWriter writer;
    model.Save(writer);
    return writer.digest();
  };
  TrafficSettings four = AsMotors(12);
  four.threads = 4;
  TrafficModel one = TrafficModel::Make(AsMotors(12), network, {}).value(),
               more = TrafficModel::Make(four, network, {}).value();
  for (int i = 0; i < 1000; ++i) one.Step(0.02, {}), more.Step(0.02, {});
  EXPECT_EQ(digest(one), digest(more));
  TrafficModel fresh = TrafficModel::Make(AsMotors(12), network, {}).value();
  base::StateWriter writer;
  one.Save(writer);
  base::StateReader reader(writer.bytes());
  fresh.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int i = 0; i < 500; ++i) one.Step(0.02, {}), fresh.Step(0.02, {});
  EXPECT_EQ(digest(one), digest(fresh));
}

TEST(Motors, WrongSettingsAreNamed) {
  const auto problem = [](const std::string& text) {
    auto file = config::File::Parse(text, "t.yaml");
    (void)ReadTraffic(file.value().root(), 1);
    const auto status = file.value().Finish();
    return status ? std::string() : status.error().Text();
  };
  EXPECT_EQ(problem("driver: motors\n"), "");
  EXPECT_EQ(problem("driver: motors\nphysics: full\n"), "");
  EXPECT_NE(problem("driver: motor\n").find("motors"), std::string::npos);
  EXPECT_NE(problem("driver: motors\nphysics: planar\n").find("'physics: full' was expected"), std::string::npos);
  EXPECT_NE(problem("driver: motors\npedestrians: {per_hour: 3}\n").find("sees no pedestrians"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::traffic

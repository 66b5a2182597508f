// SPDX-License-Identifier: Apache-2.0
// The autopilot drives the bicycle: told as drives.
#include "common/driving/driver/autopilot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/driving/driver/route_path.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/n222.hpp"

namespace rodeira::driver {
namespace {

constexpr double kStep_s = 0.001;
constexpr int kDriverEvery = 10;  // 100 Hz

// A car in a lane with its driver.
struct Drive {
  Drive(const std::shared_ptr<const road::World>& in, int lane, double start_m, double speed_mps)
      : Drive(in, std::make_unique<RoutePath>(*in->network(), StraightOn(*in->network(), {0, 0, lane}, 20'000.0)),
              start_m, speed_mps) {}
  Drive(std::shared_ptr<const road::World> in, std::unique_ptr<const Way> way, double start_m, double speed_mps)
      : world(std::move(in)),
        ground(world->MakeGround()),
        car(std::move(dynamics::LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml"))
                .value()),
        autopilot(AutopilotSettings{}, std::move(way)) {
    const LaneFrame start = autopilot.path().At(start_m);
    const auto placed = car->Initialise({.x_m = start.p_W.x(),
                                         .y_m = start.p_W.y(),
                                         .z_hint_m = start.p_W.z(),
                                         .heading_rad = start.heading_rad,
                                         .speed_mps = speed_mps},
                                        *ground);
    EXPECT_TRUE(placed.ok()) << (placed.ok() ? "" : placed.error().Text());
  }

  void Step() {
    if (k % kDriverEvery == 0) {
      controls = autopilot.Step({car->state(), car->dimensions(), others}, kStep_s * kDriverEvery);
    }
    ++k;
    car->Step(controls, *ground, kStep_s);
  }
  Way::Place Place() const {
    const auto& p = car->state().p_WB_W;
    const auto place = autopilot.path().Locate(p.x(), p.y());
    EXPECT_TRUE(place.has_value());
    return place.value_or(Way::Place{});
  }
  Footprint At(double d, double speed) const {
    const LaneFrame frame = autopilot.path().At(d);
    return {7, frame.p_W.x(), frame.p_W.y(), frame.heading_rad, speed, 4.0, 1.7};
  }

  std::shared_ptr<const road::World> world;
  std::unique_ptr<ground::Ground> ground;
  std::unique_ptr<dynamics::VehicleModel> car;
  Autopilot autopilot;
  std::vector<Footprint> others;
  dynamics::Controls controls;
  int k = 0;
};

struct Record {
  double aside_m = 0.0;    // farthest from the lane's middle
  double over_mps = -1e9;  // over the limit
  double lateral_mps2 = 0.0;
  double hand_radps = 0.0;  // fastest turn of the steering wheel
  double end_m = 0.0;
  double seconds = 0.0;
};

Record DriveToTheEnd(Drive& drive, double limit_mps, double most_s) {
  Record record;
  double wheel = 0.0;
  while (drive.k * kStep_s < most_s) {
    for (int i = 0; i < kDriverEvery; ++i) drive.Step();
    const auto& s = drive.car->state();
    const auto place = drive.Place();
    record.aside_m = std::max(record.aside_m, std::fabs(place.offset_m));
    record.over_mps = std::max(record.over_mps, s.speed_mps() - limit_mps);
    record.lateral_mps2 = std::max(record.lateral_mps2, std::fabs(s.w_WB_B.z() * s.speed_mps()));
    record.hand_radps =
        std::max(record.hand_radps, std::fabs(drive.controls.steering_wheel_rad - wheel) / (kStep_s * kDriverEvery));
    wheel = drive.controls.steering_wheel_rad;
    record.end_m = place.d_m;
    record.seconds = drive.k * kStep_s;
    if (place.d_m > 0.8 * drive.autopilot.path().length_m() && std::fabs(s.speed_mps()) < 0.05) break;
  }
  return record;
}

// What displays say is what it does: the steering wheel goes to where pure pursuit of that point has it, the speed is
// the planned one.
TEST(AutopilotAim, IsWhatItSteersAndDrivesBy) {
  Drive drive(N222OfVersion1(), -1, 150.0, 12.0);
  for (int i = 0; i < 4000; ++i) drive.Step();
  const auto& s = drive.car->state();
  const auto& size = drive.car->dimensions();
  const CarMotion motion{s.p_WB_W, s.heading_rad(), s.speed_mps(), size.wheelbase_m, size.front_m};
  const Aim aim = drive.autopilot.AimOf(motion).value();
  dynamics::Controls controls;
  for (int i = 0; i < 200; ++i)
    controls = drive.autopilot.Step({s, size, {}}, 0.02);  // hands have the time that they need
  const Eigen::Vector2d ahead(std::cos(s.heading_rad()), std::sin(s.heading_rad()));
  const double wheels = PursuitAngle(SteeringSettings{}, s.p_WB_W.head<2>() - 0.5 * size.wheelbase_m * ahead,
                                     s.heading_rad(), aim.target_W, size.wheelbase_m, s.speed_mps());
  EXPECT_NEAR(controls.steering_wheel_rad, wheels * size.steering_ratio, 1e-6);
  EXPECT_GT(std::fabs(controls.steering_wheel_rad), 1e-3) << "a road that bends";
  EXPECT_EQ(aim.speed_mps, drive.autopilot.allowed_mps());
  const Way& way = drive.autopilot.path();
  const double d_m = drive.Place().d_m;
  EXPECT_NEAR(aim.way_heading_rad, way.At(d_m).heading_rad, 1e-9);
  EXPECT_NEAR((aim.look_ahead_W - way.Position(d_m + size.front_m + AutopilotSettings{}.range_m, 0.0).head<2>()).norm(),
              0.0, 1e-6);
  CarMotion beside = motion;
  beside.p_WB_W = way.Position(0.0, 0.0) - Eigen::Vector3d(50.0 * std::cos(way.At(0.0).heading_rad),
                                                           50.0 * std::sin(way.At(0.0).heading_rad), 0.0);
  EXPECT_FALSE(drive.autopilot.AimOf(beside)) << "before the way's beginning";
}

TEST(Autopilot, KeepsItsLaneOnAWindingRoadBothWays) {
  for (const int lane : {-1, 1}) {
    Drive drive(WindingWorld(20.0), lane, 10.0, 0.0);
    const Record record = DriveToTheEnd(drive, 20.0, 200.0);
    // Lane 3.0 m, car 1.65 m: within ±0.675 m it stays in its lane.
    EXPECT_LT(record.aside_m, 0.4) << lane;
    EXPECT_LT(record.over_mps, 0.3) << lane;
    EXPECT_LT(record.lateral_mps2, 2.6) << lane;  // 2.0 planned
    EXPECT_LT(record.hand_radps, 9.01) << lane;
    const double left = drive.autopilot.path().length_m() - record.end_m;
    EXPECT_GT(left, 0.5) << lane;  // stands before the end
    EXPECT_LT(left, 12.0) << lane;
  }
}

TEST(Autopilot, DrivesTheWholeOfN222) {
  const auto world = N222();
  const network::Network& network = *world->network();
  for (const int lane : {-1, 1}) {
    Drive drive(world, std::make_unique<RoutePath>(network, StraightOn(network, {0, 0, lane}, 1e5)), 20.0, 0.0);
    const double limit = drive.autopilot.path().SpeedLimit_mps(0.0);
    const Record record = DriveToTheEnd(drive, limit, 900.0);
    EXPECT_LT(record.aside_m, 0.5) << lane;
    EXPECT_LT(record.over_mps, 0.3) << lane;
    EXPECT_LT(record.lateral_mps2, 2.8) << lane;
    EXPECT_GT(record.end_m, drive.autopilot.path().length_m() - 12.0) << lane;
    RecordProperty("seconds", std::to_string(record.seconds));
  }
}

TEST(Autopilot, ReachesAndHoldsTheLimitOnALevelAndOnAHill) {
  for (const double grade : {0.0, 0.06, -0.05}) {
    Drive drive(StraightWorld(3000, 25.0, grade), -1, 10.0, 0.0);
    for (int i = 0; i < 50000; ++i) drive.Step();
    for (int i = 0; i < 10000; ++i) {
      drive.Step();
      ASSERT_NEAR(drive.car->state().speed_mps(), 0.98 * 25.0, 0.3) << grade;
    }
  }
}

TEST(Autopilot, StopsBehindAStandingCarAndGoesOnWhenItIsGone) {
  for (const double grade : {0.0, 0.1, -0.1}) {
    Drive drive(StraightWorld(800, 25.0, grade), -1, 10.0, 0.0);
    drive.others = {drive.At(400.0, 0.0)};
    double hardest = 0.0, least = 1e9;
    const auto gap = [&] { return 400.0 - 2.0 - (drive.Place().d_m + drive.car->dimensions().front_m); };
    for (int i = 0; i < 60000; ++i) {
      drive.Step();
      hardest = std::max(hardest, -drive.car->state().a_WB_B().x());
      least = std::min(least, gap());
    }
    EXPECT_LT(std::fabs(drive.car->state().speed_mps()), 0.01) << grade;
    EXPECT_GT(least, 0.5) << grade;
    EXPECT_LT(gap(), 4.0) << grade;
    EXPECT_LT(hardest, 5.0) << grade;
    const double stopped = drive.Place().d_m;
    for (int i = 0; i < 20000; ++i) drive.Step();
    EXPECT_NEAR(drive.Place().d_m, stopped, 0.01) << grade;
    drive.others.clear();
    double least_d = stopped;
    for (int i = 0; i < 15000; ++i) {
      drive.Step();
      least_d = std::min(least_d, drive.Place().d_m);
    }
    EXPECT_GT(least_d, stopped - 0.3) << grade;  // hardly rolls back
    EXPECT_GT(drive.car->state().speed_mps(), 8.0) << grade;
  }
}

TEST(Autopilot, FollowsALeaderAtTheModelsGap) {
  Drive drive(StraightWorld(3000, 25.0), -1, 10.0, 12.0);
  double leader_m = 60.0;
  const IdmSettings idm;
  for (int i = 0; i < 120000; ++i) {
    drive.others = {drive.At(leader_m, 15.0)};
    drive.Step();
    leader_m += 15.0 * kStep_s;
  }
  const double gap = leader_m - 2.0 - (drive.Place().d_m + drive.car->dimensions().front_m);
  EXPECT_NEAR(drive.car->state().speed_mps(), 15.0, 0.1);
  EXPECT_NEAR(gap, IdmEquilibriumGap(idm, 15.0, 0.98 * 25.0), 0.5);
}

TEST(Autopilot, OncomingTrafficInItsOwnLaneDoesNotStopIt) {
  Drive drive(StraightWorld(2000, 20.0), -1, 10.0, 15.0);
  for (int i = 0; i < 20000; ++i) {
    Footprint oncoming = drive.At(1000.0, 0.0);
    const Eigen::Vector3d p = drive.autopilot.path().Position(400.0 - 15.0 * i * kStep_s, 3.0);
    oncoming = {3, p.x(), p.y(), drive.autopilot.path().At(10).heading_rad + 3.141592653589793, 15.0, 4.0, 1.7};
    drive.others = {oncoming};
    drive.Step();
    ASSERT_GT(drive.car->state().speed_mps(), 14.0);
  }
}

TEST(Autopilot, ComesBackFromBesideItsLane) {
  Drive drive(StraightWorld(1000, 15.0), -1, 50.0, 0.0);
  const Eigen::Vector3d p = drive.autopilot.path().Position(50.0, 2.0);
  ASSERT_TRUE(
      drive.car->Initialise({.x_m = p.x(), .y_m = p.y(), .heading_rad = 0.3 + 0.3, .speed_mps = 5.0}, *drive.ground)
          .ok());
  for (int i = 0; i < 15000; ++i) drive.Step();
  EXPECT_LT(std::fabs(drive.Place().offset_m), 0.05);
}

TEST(Autopilot, RestoredItGoesOnWithTheSameBits) {
  Drive a(WindingWorld(20.0), -1, 10.0, 0.0);
  Drive b(WindingWorld(20.0), -1, 30.0, 5.0);
  for (int i = 0; i < 12340; ++i) a.Step();
  base::StateWriter writer;
  a.autopilot.Save(writer);
  a.car->Save(writer);
  base::StateReader reader(writer.bytes());
  b.autopilot.Restore(reader);
  b.car->Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  b.k = a.k;
  b.controls = a.controls;
  for (int i = 0; i < 20000; ++i) {
    a.Step();
    b.Step();
  }
  base::StateWriter wa, wb;
  a.autopilot.Save(wa);
  a.car->Save(wa);
  b.autopilot.Save(wb);
  b.car->Save(wb);
  EXPECT_EQ(wa.digest(), wb.digest());
}

}  // namespace
}  // namespace rodeira::driver

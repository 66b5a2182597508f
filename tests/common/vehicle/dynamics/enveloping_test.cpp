// SPDX-License-Identifier: Apache-2.0
// A rigid ring on planes, over an edge and over a half-round bump against its closed forms, and cars that drive with
// it.
#include "common/vehicle/dynamics/enveloping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/same_bits.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/test_ground.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;
using ground::PlaneGround;

constexpr double kRadius = 0.3;
constexpr double kHalfCell_m = kRingReach / kRingPoints * kRadius;

// A height and a slope by the way along x.
class Profile final : public ground::Ground {
 public:
  struct At {
    double z_m = 0.0;
    double slope = 0.0;
    double friction = 1.0;
  };
  explicit Profile(std::function<At(double x)> of) : of_(std::move(of)) {}
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const At at = of_(queries[i].x_m);
      points[i] = {at.z_m, Vector3d(-at.slope, 0.0, 1.0).normalized(), at.friction, ground::Surface::kAsphalt, true};
    }
  }

 private:
  std::function<At(double x)> of_;
};

Profile Step(double x_m, double height_m) {
  return Profile([=](double x) { return Profile::At{x >= x_m ? height_m : 0.0, 0.0, x >= x_m ? 0.5 : 1.0}; });
}

WheelGround Under(ground::Ground& ground, const Vector3d& hub_W, const Vector3d& axle_W = Vector3d::UnitY()) {
  std::array<WheelGround, kWheels> all;
  WheelPlaces places;
  places.hubs_W.fill(hub_W);
  places.axles_W.fill(axle_W);
  QueryGround(ground, Enveloping::kRing, kRadius, places, {&all[0], &all[1], &all[2], &all[3]});
  return all[kRearRight];
}

// The hub of a ring that lies on the plane.
double HubHeight(const WheelGround& under) {
  const double slope = under.normal_W.x() / under.normal_W.z();
  return under.plane_W.z() + kRadius * std::sqrt(1.0 + slope * slope);
}

TEST(Enveloping, APlaneStaysAPlane) {
  for (const double heading : {0.0, 0.7, 2.5, -1.9}) {
    for (const double slope_x : {-1.2, -0.1, 0.0, 0.013, 0.4}) {
      for (const double slope_y : {-0.3, 0.0, 0.8}) {
        PlaneGround ground(Vector3d(1.0, -2.0, 0.3), slope_x, slope_y, 0.7);
        const Vector3d hub(14.2, 7.3, 0.3 + slope_x * 13.2 + slope_y * 9.3 + 0.29);
        const WheelGround under = Under(ground, hub, {-std::sin(heading), std::cos(heading), 0.05});
        EXPECT_NEAR(under.plane_W.z(), hub.z() - 0.29, 1e-14);
        EXPECT_LT((under.normal_W - ground.At(0, 0).normal_W).norm(), 1e-15);
        EXPECT_EQ(under.friction, 0.7);
      }
    }
  }
}

// Over an edge a distance d ahead (or behind) the hub stands at z + sqrt(R² - d²), where that is over the ground below.
TEST(Enveloping, OverAnEdgeTheHubFollowsTheRingsCircle) {
  constexpr double kHeight = 0.08;
  for (int i = -300; i <= 300; ++i) {
    const double ahead = 0.001 * i;
    Profile ground = Step(ahead, kHeight);
    const double hub = HubHeight(Under(ground, {0.0, 0.0, kRadius}));
    const auto circle = [&](double d) {
      if (d <= 0.0) return kHeight + kRadius;  // the wheel is up already
      return d < kRadius ? std::max(kRadius, kHeight + std::sqrt(kRadius * kRadius - d * d)) : kRadius;
    };
    EXPECT_LE(hub, circle(ahead - kHalfCell_m) + 1e-12) << ahead;
    EXPECT_GE(hub, circle(ahead + kHalfCell_m) - 1e-12) << ahead;
  }
  // Where the edge lies between two places it is the circle itself, and the plane its tangent with the edge's friction.
  const double ahead = 7.0 * 2.0 * kHalfCell_m - kHalfCell_m;
  Profile ground = Step(ahead, kHeight);
  const WheelGround under = Under(ground, {0.0, 0.0, kRadius});
  EXPECT_NEAR(HubHeight(under), kHeight + std::sqrt(kRadius * kRadius - ahead * ahead), 1e-12);
  EXPECT_NEAR(under.normal_W.x(), -ahead / kRadius, 1e-12);
  EXPECT_EQ(under.friction, 0.5);
}

// Over a half-round of radius r the hub moves on a circle of radius R + r about its middle.
TEST(Enveloping, OverAHalfRoundTheHubFollowsBothRadii) {
  constexpr double kRound = 0.1;
  for (int i = -350; i <= 350; ++i) {
    const double ahead = 0.001 * i;
    Profile ground([&](double x) {
      const double from = x - ahead;
      if (std::fabs(from) >= kRound) return Profile::At{};
      const double z = std::sqrt(kRound * kRound - from * from);
      return Profile::At{z, -from / z};
    });
    const double both = kRadius + kRound;
    const double hub = HubHeight(Under(ground, {0.0, 0.0, kRadius}));
    const double circle = std::fabs(ahead) < both ? std::max(kRadius, std::sqrt(both * both - ahead * ahead)) : kRadius;
    // A tangent plane lies over the round by z'' δ² / 2 within half a cell, z'' = r² / z³ at the place that is touched,
    // at most 0.66 r from the middle.
    const double over = 0.5 * kHalfCell_m * kHalfCell_m / (kRound * std::pow(1.0 - 0.66 * 0.66, 1.5));
    EXPECT_GE(hub, circle - 1e-12) << ahead;
    EXPECT_LE(hub, circle + 2.0 * over) << ahead;
  }
}

TEST(Enveloping, OutsideOfTheWorldTheWheelKeepsItsPlane) {
  HillGround ground(1, {.edge_m = 10.0});
  EXPECT_TRUE(Under(ground, {9.9, 0.0, 0.3}).inside) << "what lies ahead of it does not count";
  const WheelGround outside = Under(ground, {10.1, 0.0, 0.3});
  EXPECT_FALSE(outside.inside);
  EXPECT_EQ(outside.normal_W, Vector3d::UnitZ());
}

// With the ring, of configs/vehicles' file.
std::unique_ptr<VehicleModel> WithRing(const ModelCase& model) {
  if (!model.is_body) return MakeModel(model, "enveloping: ring\n");
  auto plain = MakeModel(model);
  if (auto* car = dynamic_cast<MultibodyModel*>(plain.get())) {
    MultibodySettings settings = car->settings();
    settings.wheel.enveloping = Enveloping::kRing;
    auto made = std::make_unique<MultibodyModel>(settings);
    EXPECT_TRUE(made->Build().ok());
    return made;
  }
  if (auto* car = dynamic_cast<OdeModel*>(plain.get())) {
    OdeSettings settings = car->settings();
    settings.car.wheel.enveloping = Enveloping::kRing;
    auto made = std::make_unique<OdeModel>(settings);
    EXPECT_TRUE(made->Build().ok());
    return made;
  }
  BicycleSettings settings = static_cast<BicycleModel&>(*plain).settings();
  settings.wheel.enveloping = Enveloping::kRing;
  return std::make_unique<BicycleModel>(settings);
}

class EnvelopingCar : public ::testing::TestWithParam<ModelCase> {};

// The front wheels meet a step where the ring does, sqrt(2 R H - H²) before the hub is over it; without a ring when the
// hub is.
TEST_P(EnvelopingCar, MeetsAStepWhereTheRingDoes) {
  constexpr double kHeight = 0.03, kSpeed = 2.0;
  const auto met = [&](VehicleModel& car) {
    Profile ground = Step(3.0, kHeight);
    EXPECT_TRUE(car.Initialise({.speed_mps = kSpeed}, ground).ok());
    const double load_N = car.state().wheels[kFrontLeft].load_N;
    for (int i = 0; i < 3000; ++i) {
      const VehicleState before = car.state();
      car.Step(Neutral(), ground, 0.001);
      if (car.state().wheels[kFrontLeft].load_N > 1.05 * load_N)
        return 3.0 - (before.p_WB_W + before.q_WB * before.wheels[kFrontLeft].hub_B).x();
    }
    return -1.0;
  };
  const double radius = MakeModel(GetParam())->dimensions().wheel_radius_m;
  const double cell = 2.0 * kRingReach / kRingPoints * radius, way = 0.001 * kSpeed;
  EXPECT_NEAR(met(*WithRing(GetParam())), std::sqrt(2.0 * radius * kHeight - kHeight * kHeight), cell + way);
  EXPECT_NEAR(met(*MakeModel(GetParam())), 0.0, 2.0 * way);
}

// On level ground the option changes no bit; on hills a snapshot goes on with the same ones.
TEST_P(EnvelopingCar, ChangesNothingOnLevelGroundAndKeepsItsBits) {
  auto ring = WithRing(GetParam()), plain = MakeModel(GetParam());
  PlaneGround level;
  ASSERT_TRUE(ring->Initialise({.speed_mps = 15.0}, level).ok());
  ASSERT_TRUE(plain->Initialise({.speed_mps = 15.0}, level).ok());
  for (int i = 0; i < 500; ++i) {
    Controls controls;
    controls.throttle = 0.5;
    controls.steering_wheel_rad = std::sin(0.01 * i);
    ring->Step(controls, level, 0.001);
    plain->Step(controls, level, 0.001);
  }
  EXPECT_EQ(DigestOf(*ring), DigestOf(*plain));
  HillGround hills(3, {});
  auto again = WithRing(GetParam());
  ExpectTheSameBitsFromASnapshot(*ring, *again, 500,
                                 [&](VehicleModel& car, int) { car.Step(Neutral(), hills, 0.001); });
}

INSTANTIATE_TEST_SUITE_P(Models, EnvelopingCar, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

// An FMU is told the ring's plane: over a step its z, the mean of the four, rises as the ring does.
TEST(Enveloping, AnFmuIsToldTheRingsPlane) {
  Profile ground = Step(3.0, 0.03);
  auto plain = MakeModel(kFmu), ring = WithRing(kFmu);
  for (VehicleModel* car : {plain.get(), ring.get()}) ASSERT_TRUE(car->Initialise({.speed_mps = 2.0}, ground).ok());
  const double to_step = 3.0 - (ring->state().p_WB_W + ring->state().wheels[kFrontLeft].hub_B).x() - 0.05;
  DriveFor(*plain, ground, Neutral(), to_step / 2.0);
  DriveFor(*ring, ground, Neutral(), to_step / 2.0);
  EXPECT_EQ(plain->state().wheels[kFrontLeft].contact_normal_W, Vector3d::UnitZ());
  EXPECT_LT(ring->state().wheels[kFrontLeft].contact_normal_W.x(), -0.1) << "5 cm before the edge";
}

}  // namespace
}  // namespace rodeira::dynamics

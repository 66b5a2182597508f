// SPDX-License-Identifier: Apache-2.0
// The prototype's suspensions on the rig against the linkages' geometry, solved by itself:
// rotations of the arms about their pivots and intersections of spheres, from nothing but the points as drawn.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <string>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/suspension_rig.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

constexpr std::array<const char*, kWheels> kSides = {"fl_", "fr_", "rl_", "rr_"};
constexpr double kPinion = 0.0069;  // m of the rack a radian of the pinion, from the file

// The two points at given distances from three others, of which the one nearer to `near`.
Vector3d ThreeSpheres(const Vector3d& a, double ra, const Vector3d& b, double rb, const Vector3d& c, double rc,
                      const Vector3d& near) {
  const Vector3d ex = (b - a).normalized();
  const double d = (b - a).norm();
  const double i = ex.dot(c - a);
  const Vector3d ey = (c - a - i * ex).normalized();
  const double j = ey.dot(c - a);
  const double x = (ra * ra - rb * rb + d * d) / (2.0 * d);
  const double y = (ra * ra - rc * rc + i * i + j * j - 2.0 * i * x) / (2.0 * j);
  const double z = std::sqrt(ra * ra - x * x - y * y);
  const Vector3d one = a + x * ex + y * ey + z * ex.cross(ey), other = a + x * ex + y * ey - z * ex.cross(ey);
  return (one - near).norm() < (other - near).norm() ? one : other;
}

// The frame of a triangle, to carry a rigid body along with it.
Eigen::Isometry3d FrameOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = (b - a).normalized();
  frame.linear().col(2) = (b - a).cross(c - a).normalized();
  frame.linear().col(1) = frame.linear().col(2).cross(frame.linear().col(0));
  frame.translation() = a;
  return frame;
}

Vector3d TurnedAbout(const Vector3d& from, const Vector3d& to, double angle_rad, const Vector3d& point) {
  return from + Eigen::AngleAxisd(angle_rad, (to - from).normalized()) * (point - from);
}

struct Corner {
  double length_m = 0.0;  // of damper or strut
  Vector3d hub, axle;
  Eigen::Isometry3d carrier = Eigen::Isometry3d::Identity();  // against where it is drawn
};

class Linkage : public ::testing::Test {
 protected:
  void SetUp() override {
    auto model = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml");
    ASSERT_TRUE(model.ok());
    settings_ = static_cast<const MultibodyModel&>(*model.value()).settings();
  }

  int Index(const std::string& name) const {
    for (std::size_t i = 0; i < settings_.mechanism.entities.size(); ++i) {
      if (settings_.mechanism.entities[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  Vector3d At(const std::string& name) const {
    return settings_.mechanism.entities[static_cast<std::size_t>(Index(name))].at;
  }

  // Double wishbone: the lower arm turned by an angle, the rack moved to the left.
  Corner Wishbones(const std::string& side, double arm_rad, double rack_m) const {
    const auto at = [&](const char* name) { return At(side + name); };
    const Vector3d lower = TurnedAbout(at("lower_front"), at("lower_rear"), arm_rad, at("lower_ball"));
    const Vector3d foot = TurnedAbout(at("lower_front"), at("lower_rear"), arm_rad, at("damper_foot"));
    const auto apart = [&](const char* a, const char* b) { return (at(a) - at(b)).norm(); };
    const Vector3d upper =
        ThreeSpheres(at("upper_front"), apart("upper_ball", "upper_front"), at("upper_rear"),
                     apart("upper_ball", "upper_rear"), lower, apart("upper_ball", "lower_ball"), at("upper_ball"));
    const Vector3d tie =
        ThreeSpheres(lower, apart("tie_outer", "lower_ball"), upper, apart("tie_outer", "upper_ball"),
                     at("rack") + Vector3d(0.0, rack_m, 0.0), apart("tie_outer", "rack"), at("tie_outer"));
    const Eigen::Isometry3d moved =
        FrameOf(lower, upper, tie) * FrameOf(at("lower_ball"), at("upper_ball"), at("tie_outer")).inverse();
    return {(at("damper_top") - foot).norm(), moved * at("hub"), moved.linear() * at("axle"), moved};
  }

  // Strut: its top lies on the carrier's line foot-neck, so that its place in the carrier follows from its distance to
  // the ball.
  Corner Strut(const std::string& side, double arm_rad) const {
    const auto at = [&](const char* name) { return At(side + name); };
    const Vector3d ball = TurnedAbout(at("arm_front"), at("arm_rear"), arm_rad, at("ball"));
    const Vector3d along = (at("strut_neck") - at("strut_foot")).normalized();
    const Vector3d beside =
        at("strut_foot") + along.dot(at("ball") - at("strut_foot")) * along;  // on the line, nearest to the ball
    const double up = std::sqrt((at("strut_top") - ball).squaredNorm() - (beside - at("ball")).squaredNorm());
    const Vector3d top_drawn = beside + up * along;  // where the drawn carrier has what is the top now
    const Vector3d toe =
        ThreeSpheres(ball, (at("toe_outer") - at("ball")).norm(), at("strut_top"), (at("toe_outer") - top_drawn).norm(),
                     at("toe_inner"), (at("toe_outer") - at("toe_inner")).norm(), at("toe_outer"));
    const Eigen::Isometry3d moved =
        FrameOf(ball, at("strut_top"), toe) * FrameOf(at("ball"), top_drawn, at("toe_outer")).inverse();
    return {(top_drawn - at("strut_foot")).norm(), moved * at("hub"), moved.linear() * at("axle"), moved};
  }

  std::array<double, kWheels> TravelsTo(const std::array<Corner, kWheels>& corners) const {
    std::array<double, kWheels> travels{};
    for (std::size_t i = 0; i < kWheels; ++i) travels[i] = corners[i].hub.z() - At(std::string(kSides[i]) + "hub").z();
    return travels;
  }
  // The wheel's lowest point.
  Vector3d Contact(const Corner& corner) const {
    return corner.hub - settings_.wheel.radius_m * (Vector3d::UnitZ() - corner.axle.z() * corner.axle).normalized();
  }
  // A corner with its hub this far above where it is drawn, by bisection of the arm's angle.
  Corner AtTravel(const std::string& side, double travel_m, double rack_m = 0.0) const {
    const auto corner = [&](double arm) { return side[0] == 'f' ? Wishbones(side, arm, rack_m) : Strut(side, arm); };
    const double up = side[1] == 'l' ? -1.0 : 1.0;
    double low = -0.3, high = 0.3;
    for (int turn = 0; turn < 60; ++turn) {
      const double middle = 0.5 * (low + high);
      (corner(up * middle).hub.z() - At(side + "hub").z() < travel_m ? low : high) = middle;
    }
    return corner(up * 0.5 * (low + high));
  }

  // Largest toe and camber changes that were seen, of a front and a rear wheel.
  struct Range {
    double low = 1.0, high = -1.0;
    void Add(double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  };

  MultibodySettings settings_;
};

TEST_F(Linkage, ToeAndCamberOverTravelAreTheGeometrys) {
  auto made = SuspensionRig::Make(settings_);
  ASSERT_TRUE(made.ok()) << made.error().Text();
  SuspensionRig rig = std::move(made).value();
  std::array<Range, kWheels> travel, toe, camber;
  for (const double pinion : {0.0, 1.5, -1.5}) {
    for (int step = -4; step <= 4; ++step) {
      const double arm = -0.04 * step;  // the left arms' axes point backwards: less is upwards
      const double rack = -kPinion * pinion;
      const std::array<Corner, kWheels> expected = {Wishbones("fl_", arm, rack), Wishbones("fr_", -arm, rack),
                                                    Strut("rl_", arm), Strut("rr_", -arm)};
      const auto status = rig.MoveTo(TravelsTo(expected), pinion);
      ASSERT_TRUE(status.ok()) << status.error().Text();
      for (std::size_t i = 0; i < kWheels; ++i) {
        const WheelPosition wheel = rig.wheel(i);
        const double outward = i % 2 == 0 ? 1.0 : -1.0;
        const Vector3d& axle = expected[i].axle;
        EXPECT_LT((wheel.centre_m - expected[i].hub).norm(), 1e-8) << i << " at " << step << ", pinion " << pinion;
        EXPECT_LT((wheel.contact_m - Contact(expected[i])).norm(), 1e-8) << i << " at " << step;
        EXPECT_NEAR(wheel.spring_m, expected[i].length_m, 1e-8) << i << " at " << step << ", pinion " << pinion;
        EXPECT_NEAR(wheel.steer_rad, std::atan2(-axle.x(), axle.y()), 1e-8) << i << " at " << step;
        EXPECT_NEAR(wheel.toe_in_rad, outward * std::atan2(axle.x(), axle.y()), 1e-8) << i << " at " << step;
        EXPECT_NEAR(wheel.camber_rad, -outward * std::asin(axle.z()), 1e-8) << i << " at " << step;
        if (pinion != 0.0) continue;
        travel[i].Add(wheel.centre_m.z() - At(std::string(kSides[i]) + "hub").z());
        toe[i].Add(wheel.toe_in_rad);
        camber[i].Add(wheel.camber_rad);
      }
    }
  }
  for (std::size_t i = 0; i < kWheels; ++i) {
    EXPECT_GT(travel[i].high, 0.045) << i;
    EXPECT_LT(travel[i].low, -0.045) << i;
    EXPECT_GT(toe[i].high - toe[i].low, 1e-3) << i << ": they do change";
    EXPECT_GT(camber[i].high - camber[i].low, 1e-2) << i;
  }
}

// What makes the car understeer as it leans: a front wheel that springs in turns outward, a rear one inward.
TEST_F(Linkage, SpringingInTurnsFrontWheelsOutAndRearWheelsIn) {
  const auto left_toe = [](const Corner& corner) {
    return std::atan2(-corner.axle.x(), corner.axle.y());
  };  // positive: to the left, outward
  const double front = left_toe(Wishbones("fl_", -0.05, 0.0)) - left_toe(Wishbones("fl_", 0.05, 0.0));
  const double rear = left_toe(Strut("rl_", -0.05)) - left_toe(Strut("rl_", 0.05));
  EXPECT_GT(Wishbones("fl_", -0.05, 0.0).hub.z(), At("fl_hub").z());
  EXPECT_GT(Strut("rl_", -0.05).hub.z(), At("rl_hub").z());
  EXPECT_GT(front, 1e-4);
  EXPECT_LT(rear, -1e-4);
}

// The steering turns a front wheel about the line through its ball joints; rear wheels it does not turn.
TEST_F(Linkage, TheSteeringAxisGoesThroughTheBallJoints) {
  auto rig = SuspensionRig::Make(settings_);
  ASSERT_TRUE(rig.ok()) << rig.error().Text();
  for (const std::size_t wheel : {0u, 1u}) {
    const auto figures = rig.value().Figures(wheel, 0.0);
    ASSERT_TRUE(figures.ok()) << figures.error().Text();
    ASSERT_TRUE(figures.value().steering_axis.has_value());
    const auto& found = *figures.value().steering_axis;
    const std::string side = kSides[wheel];
    const Vector3d lower = At(side + "lower_ball"), way = At(side + "upper_ball") - lower;
    const Vector3d contact = At(side + "hub") - settings_.wheel.radius_m * Vector3d::UnitZ();
    const Vector3d ground = lower + (contact.z() - lower.z()) / way.z() * way;
    const double outward = wheel == 0 ? 1.0 : -1.0;
    // The rotation is one of 0.1 rad of the steering wheel, not of none: hence the bounds.
    EXPECT_NEAR(found.caster_rad, std::atan2(-way.x(), way.z()), 1e-5) << wheel;
    EXPECT_NEAR(found.inclination_rad, std::atan2(-outward * way.y(), way.z()), 1e-5) << wheel;
    EXPECT_NEAR(found.scrub_radius_m, outward * (contact - ground).y(), 1e-5) << wheel;
    EXPECT_NEAR(found.trail_m, (ground - contact).x(), 1e-5) << wheel;
    EXPECT_GT(found.caster_rad, 0.01);
  }
  for (const std::size_t wheel : {2u, 3u}) {
    const auto figures = rig.value().Figures(wheel, 0.0);
    ASSERT_TRUE(figures.ok()) << figures.error().Text();
    EXPECT_FALSE(figures.value().steering_axis.has_value()) << wheel;
  }
}

// Ways, roll centre and wheel rate from the geometry's own positions above and below.
TEST_F(Linkage, FiguresOverTravelAreTheGeometrys) {
  auto rig = SuspensionRig::Make(settings_);
  ASSERT_TRUE(rig.ok()) << rig.error().Text();
  for (const double travel : {-0.03, 0.0, 0.03}) {
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      const auto figures = rig.value().Figures(wheel, travel);
      ASSERT_TRUE(figures.ok()) << figures.error().Text();
      const auto& found = figures.value();
      constexpr double kStep_m = 2e-4;
      const Corner below = AtTravel(kSides[wheel], travel - kStep_m), here = AtTravel(kSides[wheel], travel),
                   above = AtTravel(kSides[wheel], travel + kStep_m);
      const double outward = wheel % 2 == 0 ? 1.0 : -1.0;
      const Vector3d way = Contact(above) - Contact(below);
      const auto toe_in = [&](const Corner& corner) { return outward * std::atan2(corner.axle.x(), corner.axle.y()); };
      const auto camber = [&](const Corner& corner) { return -outward * std::asin(corner.axle.z()); };
      EXPECT_NEAR(found.bump_steer_radpm, (toe_in(above) - toe_in(below)) / (2 * kStep_m), 2e-4) << wheel;
      EXPECT_NEAR(found.camber_gain_radpm, (camber(above) - camber(below)) / (2 * kStep_m), 2e-4) << wheel;
      EXPECT_NEAR(found.lateral_share, outward * way.y() / (2 * kStep_m), 1e-4) << wheel;
      EXPECT_NEAR(found.forward_share, way.x() / (2 * kStep_m), 1e-4) << wheel;
      // Where the normal to the contact's path meets the middle of the car.
      EXPECT_NEAR(found.roll_centre_m, Contact(here).y() * way.y() / way.z(), 1e-4) << wheel;
      const double shortening = (below.length_m - above.length_m) / (2 * kStep_m);
      EXPECT_NEAR(found.spring_share, shortening, 1e-4) << wheel;
      // d/dz of tension times the spring's lengthening; stiffness and preload are the file's.
      const bool front = wheel < 2;
      const double stiffness = front ? 34000.0 : 18000.0, preload = front ? -2298.0 : -1302.0;
      const double drawn =
          front
              ? (At(std::string(kSides[wheel]) + "damper_foot") - At(std::string(kSides[wheel]) + "damper_top")).norm()
              : (At(std::string(kSides[wheel]) + "strut_foot") - At(std::string(kSides[wheel]) + "strut_top")).norm();
      const double tension = preload + stiffness * (here.length_m - drawn);
      const double curvature = (above.length_m - 2 * here.length_m + below.length_m) / (kStep_m * kStep_m);
      EXPECT_NEAR(found.wheel_rate_Npm, stiffness * shortening * shortening + tension * curvature, 30.0) << wheel;
      EXPECT_GT(found.wheel_rate_Npm, 8000.0);
    }
  }
}

// Where the column's spring and the force on a front wheel balance: least energy over the pinion's angle, of positions
// with the hub at its height. At a rear wheel nothing gives way.
TEST_F(Linkage, ComplianceIsThatOfTheColumnUnderTheForce) {
  auto rig = SuspensionRig::Make(settings_);
  ASSERT_TRUE(rig.ok()) << rig.error().Text();
  const double stiffness = settings_.steering.column_Nmprad;
  for (const std::size_t wheel : {0u, 1u}) {
    const auto found = rig.value().Compliance(wheel, 0.0);
    ASSERT_TRUE(found.ok()) << found.error().Text();
    const std::string side = kSides[wheel];
    const double outward = wheel == 0 ? 1.0 : -1.0;
    const Vector3d contact = Contact(AtTravel(side, 0.0));
    const auto at = [&](double pinion) { return AtTravel(side, 0.0, -kPinion * pinion); };
    const auto balance = [&](const std::function<double(const Corner&)>& work_J) {
      double low = -0.1, high = 0.1;
      constexpr double kGolden = 0.6180339887498949;
      const auto energy_J = [&](double pinion) { return 0.5 * stiffness * pinion * pinion - work_J(at(pinion)); };
      for (int turn = 0; turn < 60; ++turn) {
        const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
        (energy_J(a) < energy_J(b) ? high : low) = energy_J(a) < energy_J(b) ? b : a;
      }
      return at(0.5 * (low + high));
    };
    const auto toe_in = [&](const Corner& corner) { return outward * std::atan2(corner.axle.x(), corner.axle.y()); };
    const auto camber = [&](const Corner& corner) { return -outward * std::asin(corner.axle.z()); };
    const auto expect = [&](const WheelCompliance::Change& change, double force, const Corner& corner) {
      const Corner drawn = at(0.0);
      EXPECT_NEAR(force * change.toe_in_rad, toe_in(corner) - toe_in(drawn),
                  0.02 * std::fabs(toe_in(corner) - toe_in(drawn)) + 1e-7);
      EXPECT_NEAR(force * change.camber_rad, camber(corner) - camber(drawn),
                  0.02 * std::fabs(toe_in(corner) - toe_in(drawn)) + 1e-7);
    };
    constexpr double kForce_N = 100.0, kTorque_Nm = 10.0;
    expect(found.value().lateral, kForce_N,
           balance([&](const Corner& corner) { return kForce_N * outward * (corner.carrier * contact).y(); }));
    expect(found.value().longitudinal, kForce_N,
           balance([&](const Corner& corner) { return kForce_N * (corner.carrier * contact).x(); }));
    expect(found.value().aligning, kTorque_Nm, balance([&](const Corner& corner) {
             const Eigen::AngleAxisd turned(corner.carrier.linear());
             return -outward * kTorque_Nm * turned.angle() * turned.axis().z();
           }));
    EXPECT_GT(std::fabs(found.value().lateral.toe_in_rad), 1e-7) << wheel;
    EXPECT_GT(found.value().aligning.toe_in_rad, 1e-6) << "it gives way to the torque";
  }
  for (const std::size_t wheel : {2u, 3u}) {
    const auto found = rig.value().Compliance(wheel, 0.0);
    ASSERT_TRUE(found.ok()) << found.error().Text();
    EXPECT_NEAR(found.value().aligning.toe_in_rad, 0.0, 1e-12) << wheel;
    EXPECT_NEAR(found.value().lateral.camber_rad, 0.0, 1e-12) << wheel;
  }
}

TEST_F(Linkage, WhatTheSuspensionDoesNotReachIsTold) {
  auto rig = SuspensionRig::Make(settings_);
  ASSERT_TRUE(rig.ok()) << rig.error().Text();
  ASSERT_TRUE(rig.value().MoveTo({0.02, 0.02, 0.02, 0.02}, 0.0).ok());
  const auto status = rig.value().MoveTo({0.02, 0.9, 0.02, 0.02}, 0.0);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "vehicle.travel_out_of_reach");
  EXPECT_NE(status.error().message.find("front_right"), std::string::npos) << status.error().message;
  EXPECT_NEAR(rig.value().wheel(1).centre_m.z(), At("fr_hub").z() + 0.02, 1e-9) << "it stays where it was";
}

// A rack that no pinion holds.
TEST_F(Linkage, ALooseMechanismIsRefused) {
  MultibodySettings loose = settings_;
  ASSERT_EQ(std::erase_if(loose.mechanism.rows, [](const auto& row) { return row.name == "pinion"; }), 1u);
  const auto rig = SuspensionRig::Make(loose);
  ASSERT_FALSE(rig.ok());
  EXPECT_EQ(rig.error().id.text(), "vehicle.loose_suspension");
  EXPECT_NE(rig.error().message.find("1 way"), std::string::npos) << rig.error().message;
}

}  // namespace
}  // namespace rodeira::dynamics

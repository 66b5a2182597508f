// SPDX-License-Identifier: Apache-2.0
// Toe and camber of the prototype's wheels over their travel against the linkages' geometry, solved by itself:
// rotations of the arms about their pivots and intersections of spheres, from nothing but the points as drawn.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <string>

#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

using Eigen::Vector3d;

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
    return {(at("damper_top") - foot).norm(), moved * at("hub"), moved.linear() * at("axle")};
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
    return {(top_drawn - at("strut_foot")).norm(), moved * at("hub"), moved.linear() * at("axle")};
  }

  // The mechanism with its chassis held where it is drawn, springs at given lengths, the column turned.
  std::unique_ptr<multibody::System> Held(const std::array<Corner, kWheels>& corners, double pinion_rad) const {
    multibody::Drawing drawing = settings_.mechanism;
    drawing.loads.clear();
    for (const int entity : drawing.bodies[static_cast<std::size_t>(settings_.chassis)].entities)
      drawing.entities[static_cast<std::size_t>(entity)].fixed = {true, true, true};
    const auto hold = [&drawing](int entity, double value) {
      drawing.entities[static_cast<std::size_t>(entity)].at.x() = value;
      drawing.entities[static_cast<std::size_t>(entity)].fixed[0] = true;
    };
    hold(settings_.steering.angle, pinion_rad);
    for (std::size_t i = 0; i < kWheels; ++i) hold(settings_.wheels[i].travel, corners[i].length_m);
    auto system = multibody::System::Make(drawing);
    EXPECT_TRUE(system.ok()) << (system.ok() ? "" : system.error().Text());
    const auto status = system.value()->Assemble();
    EXPECT_TRUE(status.ok()) << status.error().Text();
    return std::move(system).value();
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
  std::array<Range, kWheels> travel, toe, camber;
  for (const double pinion : {0.0, 1.5, -1.5}) {
    for (int step = -4; step <= 4; ++step) {
      const double arm = -0.04 * step;  // the left arms' axes point backwards: less is upwards
      const double rack = -kPinion * pinion;
      const std::array<Corner, kWheels> expected = {Wishbones("fl_", arm, rack), Wishbones("fr_", -arm, rack),
                                                    Strut("rl_", arm), Strut("rr_", -arm)};
      const auto system = Held(expected, pinion);
      for (std::size_t i = 0; i < kWheels; ++i) {
        const Vector3d hub = system->motion().At(settings_.wheels[i].centre),
                       axle = system->motion().At(settings_.wheels[i].axle);
        EXPECT_LT((hub - expected[i].hub).norm(), 1e-8) << i << " at " << step << ", pinion " << pinion;
        const auto toe_of = [](const Vector3d& a) { return std::atan2(-a.x(), a.y()); };
        EXPECT_NEAR(toe_of(axle), toe_of(expected[i].axle), 1e-8) << i << " at " << step << ", pinion " << pinion;
        EXPECT_NEAR(std::asin(axle.z()), std::asin(expected[i].axle.z()), 1e-8)
            << i << " at " << step << ", pinion " << pinion;
        if (pinion != 0.0) continue;
        travel[i].Add(hub.z() - At(i == 0 ? "fl_hub" : i == 1 ? "fr_hub" : i == 2 ? "rl_hub" : "rr_hub").z());
        toe[i].Add(toe_of(axle));
        camber[i].Add(std::asin(axle.z()));
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

}  // namespace
}  // namespace rodeira::dynamics

// SPDX-License-Identifier: Apache-2.0
// How far cars with full physics reach beside bends: on a circle in closed form, on maps beside cars of the vehicle
// library.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/traffic/network/swing.hpp"
#include "common/traffic/network/tight_bends.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/lanes/swath.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

TrafficSettings Full() {
  TrafficSettings settings;
  settings.physics = Physics::kFull;
  return settings;
}

// A lane that turns to the right by 75° on a radius of 2.9 m, tighter than a van's wheels turn (3.8 m), as one of
// Town04 does.
std::shared_ptr<const network::Network> BendOf29() {
  opendrive::RoadText road;
  constexpr double kRadius_m = 4.65, kTurn = 1.31;  // the lane's middle is 1.75 m nearer
  const double arc = kRadius_m * kTurn;
  const auto piece = [](double s, double x, double y, double heading, double length, const std::string& kind) {
    return fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>", s, x, y, heading,
                       length, kind);
  };
  const double x = 40.0 + kRadius_m * std::sin(kTurn), y = -kRadius_m * (1.0 - std::cos(kTurn));
  road.length = 80.0 + arc;
  road.left = "";
  road.geometry = piece(0.0, 0.0, 0.0, 0.0, 40.0, "<line/>") +
                  piece(40.0, 40.0, 0.0, 0.0, arc, fmt::format("<arc curvature=\"{}\"/>", -1.0 / kRadius_m)) +
                  piece(40.0 + arc, x, y, -kTurn, 40.0, "<line/>");
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

constexpr double kStraight_m = 60.0;

// A lane that turns to the right by 90° on this radius, between straight ones.
std::shared_ptr<const network::Network> BendOf(double radius_m) {
  opendrive::RoadText road;
  const double middle_m = radius_m + 1.75, turn = 0.5 * std::numbers::pi, arc = middle_m * turn;
  const auto piece = [](double s, double x, double y, double heading, double length, const std::string& kind) {
    return fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>", s, x, y, heading,
                       length, kind);
  };
  road.length = 2.0 * kStraight_m + arc;
  road.left = "";
  road.geometry =
      piece(0.0, 0.0, 0.0, 0.0, kStraight_m, "<line/>") +
      piece(kStraight_m, kStraight_m, 0.0, 0.0, arc, fmt::format("<arc curvature=\"{}\"/>", -1.0 / middle_m)) +
      piece(kStraight_m + arc, kStraight_m + middle_m, -middle_m, -turn, kStraight_m, "<line/>");
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

// A car that is steered by its front wheels, with a mean of the axles' circles that is the line of radius R: its rear
// axle runs on R - L² / (4 R), tangent to its circle, its outer corner in front on √((ρ + w/2)² + (L + o)²), its inner
// side beside the rear axle on ρ - w/2.
TEST(Swing, OnACircleIsThatOfACarSteeredInFront) {
  const lanes::LargestCar car = LargestOf(Full());
  for (const double round_m : {45.0, 60.0, 90.0}) {
    const auto network = Ring(round_m);
    const lanes::Graph graph(*network);
    const lanes::Swings swings = SwingsOf(graph, Full());
    int nodes = 0;
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const auto& line = graph[track].curve.nodes();
      const double R = 1.0 / std::fabs(line[line.size() / 2].curvature_1pm);
      const double rear = R - car.wheelbase_m * car.wheelbase_m / (4.0 * R),
                   overhang = 0.5 * (car.length_m - car.wheelbase_m);
      const double outside = std::hypot(rear + 0.5 * car.width_m, car.wheelbase_m + overhang) - R,
                   inside = R - (rear - 0.5 * car.width_m);
      ASSERT_EQ(swings[track].size(), line.size());
      for (std::size_t i = 0; i < line.size(); ++i, ++nodes) {
        const bool left = line[i].curvature_1pm > 0.0;
        EXPECT_NEAR(left ? swings[track][i].right_m : swings[track][i].left_m, outside, 0.06) << R << " " << i;
        EXPECT_NEAR(left ? swings[track][i].left_m : swings[track][i].right_m, inside, 0.06) << R << " " << i;
      }
    }
    EXPECT_GT(nodes, 10);
  }
}

// Wherever a car of the vehicle library comes on its way through the maps' bends, no point of its outline is farther
// out than conflict zones are told; beyond what curvatures say of cars that keep to their lines some are.
TEST(Swing, HoldsWhatCarsOfTheMapsDo) {
  int beyond = 0, looks = 0;
  for (const char* map : {"crossing", "roundabout", "town", "bend"}) {
    for (const bool heavy : {false, true}) {
      TrafficSettings settings = Full();
      settings.vehicles = 25;
      if (heavy && map == std::string("bend")) continue;  // no lorry gets round it
      if (heavy) settings.mix.shares = {0.4, 0.2, 0.2, 0.2};
      TrafficModel model =
          TrafficModel::Make(settings, map == std::string("bend") ? BendOf29() : lanes::MapNetwork(map), {}).value();
      const lanes::Swings swings = SwingsOf(model.graph(), settings);
      const lanes::LargestCar largest = LargestOf(settings);
      for (int step = 0; step < BriefOrLong(900, 4000); ++step) {
        model.Step(0.01, {});
        if (step % 10 != 0) continue;
        for (const AgentPose& pose : model.poses()) {
          const Agent& agent = model.agent(pose.id);
          const AgentTraits& traits = model.traits(pose.id);
          const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
          const Eigen::Vector2d ahead = forward.head<2>().normalized(), left(-ahead.y(), ahead.x());
          for (const double along : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
            for (const double side : {-0.5, 0.5}) {
              const Eigen::Vector2d p =
                  pose.p_WB_W.head<2>() + along * traits.length_m * ahead + side * traits.width_m * left;
              const double at = agent.o_m + along * traits.length_m;
              const Piece& piece = PieceAt(agent.path, at);
              if (piece.offset_m != 0.0 || piece.slope != 0.0 || piece.aside_m != 0.0) continue;
              const lanes::Curve& curve = model.graph()[piece.track].curve;
              const auto& nodes = curve.nodes();
              const auto near = std::min_element(nodes.begin(), nodes.end(), [&](const auto& a, const auto& b) {
                return (a.p_W.template head<2>() - p).norm() < (b.p_W.template head<2>() - p).norm();
              });
              const auto index = static_cast<std::size_t>(near - nodes.begin());
              const lanes::Curve::Foot foot = curve.FootNear(p, index);
              if (foot.d_m <= 0.0 || foot.d_m >= curve.length_m()) continue;
              const double half = lanes::HalfSwath_m(near->curvature_1pm, largest);
              double most = half;
              if (!swings[piece.track].empty())
                most = std::max(
                    half, foot.offset_m > 0.0 ? swings[piece.track][index].left_m : swings[piece.track][index].right_m);
              ++looks;
              if (std::fabs(foot.offset_m) > half) ++beyond;
              EXPECT_LE(std::fabs(foot.offset_m), most)
                  << map << ", body " << traits.body << " on track " << piece.track << " at " << foot.d_m << ", "
                  << 0.01 * step << " s";
            }
          }
        }
      }
    }
  }
  EXPECT_GT(looks, 100000);
  EXPECT_GT(beyond, 100);  // it says something
  RecordProperty("beyond", beyond);
}

// A vehicle that leaves a tight bend gains speed while the steering turns back: 15 m behind it a bus is on its line,
// and zones are hardly wider for it.
TEST(Swing, ACarThatLeavesABendGainsSpeedAsDriversDo) {
  TrafficSettings settings = Full();
  settings.mix.shares = {0.5, 0.0, 0.0, 0.5};
  const double half_m = 0.5 * LargestOf(settings).width_m;
  for (const double radius_m : {7.0, 9.0, 12.0, 16.0}) {
    const auto network = BendOf(radius_m);
    const lanes::Graph graph(*network);
    const lanes::Swings swings = SwingsOf(graph, settings);
    ASSERT_EQ(swings.size(), 1u);
    double in_bend_m = 0.0, behind_m = 0.0;
    const auto& nodes = graph[0].curve.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double after_m = nodes[i].d_m - (graph[0].length_m() - kStraight_m),
                   out_m = std::max(swings[0][i].left_m, swings[0][i].right_m);
      double& most_m = after_m > 15.0 ? behind_m : in_bend_m;
      most_m = std::max(most_m, out_m);
    }
    EXPECT_GT(in_bend_m, half_m + 1.0) << radius_m;
    EXPECT_LT(behind_m, half_m + 0.15) << radius_m;
  }
}

// Straight roads are as wide as before, and one that keeps to its line, or knows no zones, has none.
TEST(Swing, IsNothingOnStraightRoadsNorOfPlanarCars) {
  int compared = 0;
  for (const std::string& name : lanes::MapNames()) {
    const auto network = lanes::MapNetwork(name);
    const lanes::Graph graph(*network);
    EXPECT_TRUE(SwingsOf(graph, TrafficSettings()).empty());
    TrafficSettings motors = Full();
    motors.driver = DriverKind::kMotors;
    EXPECT_TRUE(SwingsOf(graph, motors).empty());
    const lanes::LargestCar car = LargestOf(Full());
    const lanes::Swings swings = SwingsOf(graph, Full());
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const auto& nodes = graph[track].curve.nodes();
      const bool is_straight = std::all_of(nodes.begin(), nodes.end(),
                                           [](const auto& node) { return std::fabs(node.curvature_1pm) < 1e-6; });
      if (!is_straight || swings[track].empty()) continue;
      const std::size_t middle = nodes.size() / 2;
      if (nodes[middle].d_m < 20.0 || graph[track].length_m() - nodes[middle].d_m < 20.0) continue;
      EXPECT_LE(std::max(swings[track][middle].left_m, swings[track][middle].right_m), 0.5 * car.width_m + 1e-3)
          << name << " " << track;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0);
}

// A circle of 10.4 m radius on a lane of 3.5 m: a bus's tyres are 2.5 / 2 + 5.3² / (4 R) from the line; nothing of
// vans, of planar buses, or where there is room.
TEST(TightBends, AreThoseOfTheClosedForm) {
  TrafficSettings settings = Full();
  settings.mix.shares = {0.0, 0.5, 0.0, 0.5};
  const auto network = Ring(54.0);
  const lanes::Graph graph(*network);
  const auto bends = TightBendsOf(graph, settings);
  ASSERT_EQ(bends.size(), 1u);
  const auto& nodes = graph[bends[0].track].curve.nodes();
  const double radius = 1.0 / std::fabs(nodes[nodes.size() / 2].curvature_1pm);
  EXPECT_NEAR(bends[0].radius_m, radius, 1e-2);
  EXPECT_NEAR(bends[0].off_m, 1.25 + 5.3 * 5.3 / (4.0 * radius) - 1.75, 1e-3);
  EXPECT_TRUE(bends[0].turns);
  EXPECT_NE(Text(bends[0], graph).find("a bus of 10.5 m"), std::string::npos);
  settings.physics = Physics::kPlanar;
  EXPECT_TRUE(TightBendsOf(graph, settings).empty());
  const auto wide = Ring(200.0);
  EXPECT_TRUE(TightBendsOf(lanes::Graph(*wide), Full()).empty());
  const auto tight = BendOf29();
  const lanes::Graph bend(*tight);
  const auto vans = TightBendsOf(bend, Full());
  ASSERT_FALSE(vans.empty());
  EXPECT_FALSE(vans.back().turns);  // on 2.9 m no van's wheels turn
}

}  // namespace
}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// Crossings with arms that bend up to the line, so that vehicles wait slanted in narrow lanes: none is hit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/demand_road.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.05, kFor_s = 300.0, kBend_m = 40.0, kStraight_m = 120.0, kNear_m = 15.0;
constexpr int kArms = 4;

// Four arms, turned against one another by a quarter; right-hand traffic.
struct Shape {
  const char* name;
  double skew_rad, curvature_1pm;  // of an arm, where it leaves the crossing
  double radius_m;                 // from the middle to the arms
  int lanes;                       // a direction
  double width_m;
};

void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

struct Place {
  double x = 0.0, y = 0.0, heading = 0.0;
};

std::string Lane(int id, const Shape& shape, const std::string& link = "") {
  return fmt::format(
      "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" "
      "d=\"0\"/><roadMark "
      "sOffset=\"0\" type=\"{}\" color=\"white\" width=\"0.12\"/><speed sOffset=\"0\" max=\"13.9\" "
      "unit=\"m/s\"/></lane>",
      id, link, shape.width_m, std::abs(id) < shape.lanes ? "broken" : "solid");
}

std::string Geometry(double s, const Place& at, double length, const std::string& shape) {
  return fmt::format(
      "<geometry s=\"{:.17g}\" x=\"{:.17g}\" y=\"{:.17g}\" hdg=\"{:.17g}\" length=\"{:.17g}\">{}</geometry>", s, at.x,
      at.y, at.heading, length, shape);
}

// Hermite's cubic.
void Curve(opendrive::RoadText& road, const Place& from, const Place& to) {
  const double c = std::cos(from.heading), s = std::sin(from.heading), turn = to.heading - from.heading;
  const Eigen::Vector2d end(c * (to.x - from.x) + s * (to.y - from.y), c * (to.y - from.y) - s * (to.x - from.x));
  const Eigen::Vector2d b = end.norm() * Eigen::Vector2d::UnitX(),
                        e = end.norm() * Eigen::Vector2d(std::cos(turn), std::sin(turn)), c2 = 3.0 * end - 2.0 * b - e,
                        d3 = b + e - 2.0 * end;
  constexpr int kParts = 2000;
  road.length = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double p = (i + 0.5) / kParts;
    road.length += (b + 2.0 * p * c2 + 3.0 * p * p * d3).norm() / kParts;
  }
  road.geometry = Geometry(0.0, from, road.length,
                           fmt::format("<paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"{:.17g}\" cU=\"{:.17g}\" "
                                       "dU=\"{:.17g}\" aV=\"0\" bV=\"0\" cV=\"{:.17g}\" dV=\"{:.17g}\"/>",
                                       b.x(), c2.x(), d3.x(), c2.y(), d3.y()));
}

// Every arm leads to every other one, each lane to the same lane.
std::shared_ptr<const network::Network> Crossing(const Shape& shape) {
  std::string text, connections;
  std::array<Place, kArms> arms;
  for (int arm = 0; arm < kArms; ++arm) {
    const double angle = 0.5 * std::numbers::pi * arm, k = shape.curvature_1pm, heading = angle + shape.skew_rad;
    arms[static_cast<std::size_t>(arm)] = {shape.radius_m * std::cos(angle), shape.radius_m * std::sin(angle), heading};
    const Place& at = arms[static_cast<std::size_t>(arm)];
    const Place on{at.x + (std::sin(heading + k * kBend_m) - std::sin(heading)) / k,
                   at.y - (std::cos(heading + k * kBend_m) - std::cos(heading)) / k, heading + k * kBend_m};
    opendrive::RoadText road;
    road.id = std::to_string(arm + 1), road.length = kBend_m + kStraight_m;
    road.link = "<predecessor elementType=\"junction\" elementId=\"100\"/>";
    road.geometry = Geometry(0.0, at, kBend_m, fmt::format("<arc curvature=\"{:.17g}\"/>", k)) +
                    Geometry(kBend_m, on, kStraight_m, "<line/>");
    road.left = road.right = "";
    for (int lane = 1; lane <= shape.lanes; ++lane)
      road.left = Lane(lane, shape) + road.left, road.right += Lane(-lane, shape);
    text += road.Text();
  }
  for (int from = 0; from < kArms; ++from) {
    for (int to = 0; to < kArms; ++to) {
      if (to == from) continue;
      Place begins = arms[static_cast<std::size_t>(from)];
      begins.heading += std::numbers::pi;
      opendrive::RoadText road;
      const int id = 50 + kArms * from + to;
      road.id = std::to_string(id), road.attributes = "junction=\"100\"";
      road.link = fmt::format(
          "<predecessor elementType=\"road\" elementId=\"{}\" contactPoint=\"start\"/><successor elementType=\"road\" "
          "elementId=\"{}\" contactPoint=\"start\"/>",
          from + 1, to + 1);
      Curve(road, begins, arms[static_cast<std::size_t>(to)]);
      road.left = road.right = "";
      std::string links;
      for (int lane = 1; lane <= shape.lanes; ++lane) {
        road.right += Lane(-lane, shape, fmt::format("<predecessor id=\"{}\"/><successor id=\"-{}\"/>", lane, lane));
        links += fmt::format("<laneLink from=\"{}\" to=\"-{}\"/>", lane, lane);
      }
      text += road.Text();
      connections += fmt::format(
          "<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" contactPoint=\"start\">{}</connection>", id,
          from + 1, id, links);
    }
  }
  return opendrive::MustRead(
      opendrive::Document(text + "<junction id=\"100\" name=\"\">" + connections + "</junction>"));
}

struct Counted {
  int contacts = 0;
  int slanted = 0;  // steps of vehicles that stood in the bend near their line, or in the crossing
  std::uint64_t ended = 0;
};

Counted Drive(const Shape& shape, std::uint64_t seed) {
  TrafficSettings settings =
      Settings("flows:\n  - {vehicles_per_h: 1400, mix: {car: 3, van: 1, lorry: 1, bus: 1}}\n", seed);
  settings.vehicles = TrafficSettings::kMaxOfFlows;
  TrafficModel model = TrafficModel::Make(settings, Crossing(shape), {}).value();
  Counted counted;
  for (double t = 0.0; t < kFor_s; t += kStep_s) {
    model.Step(kStep_s, {});
    std::vector<driver::Footprint> boxes;
    for (const AgentPose& pose : model.poses()) boxes.push_back(FootprintOf(pose, model.traits(pose.id)));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const bool near = std::hypot(boxes[i].x_m, boxes[i].y_m) < shape.radius_m + kNear_m;
      counted.slanted += near && model.poses()[i].speed_mps < 0.1 ? 1 : 0;
      for (std::size_t k = i + 1; k < boxes.size(); ++k)
        counted.contacts += driver::Overlap(boxes[i], boxes[k]) ? 1 : 0;
    }
  }
  counted.ended = model.ended();
  return counted;
}

class CurvedCrossing : public ::testing::TestWithParam<Shape> {};

TEST_P(CurvedCrossing, SlantedVehiclesAreNotHit) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Counted counted = Drive(GetParam(), seed);
    EXPECT_EQ(counted.contacts, 0) << seed;
    EXPECT_GT(counted.slanted, 2000) << seed;
    EXPECT_GT(counted.ended, 40u) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CurvedCrossing,
                         ::testing::Values(Shape{"OneLane", 0.4, -1.0 / 40.0, 14.0, 1, 3.5},
                                           Shape{"OneLaneToTheLeft", -0.4, 1.0 / 40.0, 14.0, 1, 3.5},
                                           Shape{"TwoLanesToTheLeft", -0.4, 1.0 / 45.0, 20.0, 2, 3.25}),
                         [](const auto& shape) { return std::string(shape.param.name); });

}  // namespace
}  // namespace rodeira::traffic

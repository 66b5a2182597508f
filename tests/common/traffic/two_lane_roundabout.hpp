// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {

// A roundabout of two lanes with four arms: roads in0 … in3 of two lanes lead to it, out0 … out3 of one lane leave it,
// from the ring's outer lane only; ring0 … ring3 lie between the arms, 24 m long. In junctions no lanes are changed.
class RoundaboutOfTwoLanes {
 public:
  static std::shared_ptr<const network::Network> Network() { return opendrive::MustRead(Text()); }

 private:
  struct Place {
    double x = 0.0, y = 0.0, heading = 0.0;
  };

  static constexpr double kRadius_m = 28.0, kWidth_m = 3.5, kArmBegins_m = 52.0, kArmLength_m = 160.0, kHalf = 0.35;

  static Place OnCircle(double radius_m, double angle) {
    return {radius_m * std::cos(angle), radius_m * std::sin(angle), angle + 0.5 * std::numbers::pi};
  }
  static Place OnArm(double angle, double along_m, double left_m, bool inward) {
    return {along_m * std::cos(angle) - left_m * std::sin(angle), along_m * std::sin(angle) + left_m * std::cos(angle),
            angle + (inward ? std::numbers::pi : 0.0)};
  }

  static void Shape(opendrive::RoadText& road, const Place& at, double length_m, const std::string& shape) {
    road.length = length_m;
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"{:.17g}\" y=\"{:.17g}\" hdg=\"{:.17g}\" length=\"{:.17g}\">{}</geometry>",
                    at.x, at.y, at.heading, length_m, shape);
  }
  static void Arc(opendrive::RoadText& road, double from, double to) {
    Shape(road, OnCircle(kRadius_m, from), kRadius_m * (to - from),
          fmt::format("<arc curvature=\"{:.17g}\"/>", 1.0 / kRadius_m));
  }
  // Hermite's cubic.
  static void Curve(opendrive::RoadText& road, const Place& from, const Place& to) {
    const double c = std::cos(from.heading), s = std::sin(from.heading), turn = to.heading - from.heading;
    const Eigen::Vector2d end(c * (to.x - from.x) + s * (to.y - from.y), c * (to.y - from.y) - s * (to.x - from.x));
    const Eigen::Vector2d b = end.norm() * Eigen::Vector2d::UnitX(),
                          e = end.norm() * Eigen::Vector2d(std::cos(turn), std::sin(turn)),
                          c2 = 3.0 * end - 2.0 * b - e, d3 = b + e - 2.0 * end;
    constexpr int kParts = 2000;
    double length = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const double p = (i + 0.5) / kParts;
      length += (b + 2.0 * p * c2 + 3.0 * p * p * d3).norm() / kParts;
    }
    Shape(road, from, length,
          fmt::format("<paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"{:.17g}\" cU=\"{:.17g}\" dU=\"{:.17g}\" "
                      "aV=\"0\" bV=\"0\" cV=\"{:.17g}\" dV=\"{:.17g}\"/>",
                      b.x(), c2.x(), d3.x(), c2.y(), d3.y()));
  }

  static std::string Lanes(int count, const std::string& link, double limit_mps) {
    std::string text;
    for (int id = 1; id <= count; ++id) {
      text += fmt::format(
          "<lane id=\"-{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" "
          "d=\"0\"/><roadMark sOffset=\"0\" type=\"{}\" color=\"white\" width=\"0.12\"/><speed sOffset=\"0\" "
          "max=\"{}\" unit=\"m/s\"/></lane>",
          id, fmt::format(fmt::runtime(link), id), kWidth_m, id < count ? "broken" : "solid", limit_mps);
    }
    return text;
  }
  static std::string Junction(const char* end, int arm) {
    return fmt::format("<{} elementType=\"junction\" elementId=\"{}\"/>", end, 10 + arm);
  }
  static std::string Roads(const std::string& from, const std::string& to) {
    return fmt::format(
        "<predecessor elementType=\"road\" elementId=\"{}\" contactPoint=\"end\"/><successor elementType=\"road\" "
        "elementId=\"{}\" contactPoint=\"start\"/>",
        from, to);
  }

  static std::string Text() {
    constexpr double kArm_mps = 13.9, kRing_mps = 8.3, kGap_m = 1.0;
    const char* both = "<predecessor id=\"-{0}\"/><successor id=\"-{0}\"/>";
    std::string text, junctions;
    for (int arm = 0; arm < 4; ++arm) {
      const double angle = 0.5 * std::numbers::pi * arm, next = angle + 0.5 * std::numbers::pi;
      const int before = (arm + 3) % 4;
      const std::string in = fmt::format("in{}", arm), out = fmt::format("out{}", arm),
                        ring = fmt::format("ring{}", arm), last = fmt::format("ring{}", before);
      opendrive::RoadText road;
      road.left = "";
      const auto add = [&](const std::string& id, const std::string& link, const std::string& lanes, bool inside) {
        road.id = id, road.link = link, road.right = lanes;
        road.attributes = inside ? fmt::format("junction=\"{}\"", 10 + arm) : "junction=\"-1\"";
        text += road.Text();
      };
      Shape(road, OnArm(angle, kArmBegins_m + kArmLength_m, kGap_m, true), kArmLength_m, "<line/>");
      add(in, Junction("successor", arm), Lanes(2, "", kArm_mps), false);
      Shape(road, OnArm(angle, kArmBegins_m, -kGap_m, false), kArmLength_m, "<line/>");
      add(out, Junction("predecessor", arm), Lanes(1, "", kArm_mps), false);
      Arc(road, angle + kHalf, next - kHalf);
      add(ring, Junction("predecessor", arm) + Junction("successor", (arm + 1) % 4), Lanes(2, "", kRing_mps), false);
      Arc(road, angle - kHalf, angle + kHalf);
      add("past" + std::to_string(arm), Roads(last, ring), Lanes(2, both, kRing_mps), true);
      Curve(road, OnArm(angle, kArmBegins_m, kGap_m, true), OnCircle(kRadius_m, angle + kHalf));
      add("enter" + std::to_string(arm), Roads(in, ring), Lanes(2, both, kRing_mps), true);
      Curve(road, OnCircle(kRadius_m + kWidth_m, angle - kHalf), OnArm(angle, kArmBegins_m, -kGap_m, false));
      add("leave" + std::to_string(arm), Roads(last, out),
          Lanes(1, "<predecessor id=\"-2\"/><successor id=\"-1\"/>", kRing_mps), true);
      junctions += fmt::format(
          "<junction id=\"{0}\" name=\"\"><connection id=\"0\" incomingRoad=\"{1}\" connectingRoad=\"past{4}\" "
          "contactPoint=\"start\"><laneLink from=\"-1\" to=\"-1\"/><laneLink from=\"-2\" to=\"-2\"/></connection>"
          "<connection id=\"1\" incomingRoad=\"{2}\" connectingRoad=\"enter{4}\" contactPoint=\"start\"><laneLink "
          "from=\"-1\" to=\"-1\"/><laneLink from=\"-2\" to=\"-2\"/></connection><connection id=\"2\" "
          "incomingRoad=\"{1}\" connectingRoad=\"leave{4}\" contactPoint=\"start\"><laneLink from=\"-2\" "
          "to=\"-1\"/></connection></junction>",
          10 + arm, last, in, out, arm);
    }
    return opendrive::Document(text + junctions);
  }
};

}  // namespace rodeira::traffic

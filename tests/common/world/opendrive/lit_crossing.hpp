// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {

// A crossing of four roads of one lane a direction, with lights, as an OpenDRIVE text. Arm i comes from the direction
// of i quarter turns from east.
struct LitCrossing {
  enum class Orientation { kOfTraffic, kFaced, kNone };

  Orientation orientation = Orientation::kOfTraffic;
  bool validity = true;          // the lights name their lanes
  bool validity_turned = false;  // … from the larger to the smaller number
  int heads = 1;                 // a lane
  bool referenced = false;       // all lights are signals of the first arm; the others have references
  std::vector<bool> outward = std::vector<bool>(4, false);  // by arm: its road begins at the junction
  std::vector<std::vector<int>> groups = {{0, 2}, {1, 3}};  // the arms of each controller
  std::string times;                                        // by hand, of the first controller; empty: none

  static constexpr double kHalf_m = 14.0, kArm_m = 150.0, kLight_m = 2.0;  // a light, before the arm's end

  std::string Text() const {
    std::string text;
    for (int arm = 0; arm < 4; ++arm) text += Arm(arm);
    std::string connections;
    for (int from = 0; from < 4; ++from) {
      for (int turn = 1; turn < 4; ++turn) text += Way(from, turn, connections);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      text += fmt::format("<controller id=\"c{}\" name=\"group {}\">", g, g);
      for (const int arm : groups[g]) {
        for (int head = 0; head < heads; ++head)
          text += fmt::format("<control signalId=\"{}\" type=\"0\"/>", Head(arm, head));
      }
      if (g == 0 && !times.empty()) text += "<userData code=\"rodeira:times\" value=\"" + times + "\"/>";
      text += "</controller>\n";
    }
    text += "<junction id=\"9\" name=\"crossing\">\n" + connections;
    for (std::size_t g = 0; g < groups.size(); ++g)
      text += fmt::format("<controller id=\"c{}\" sequence=\"{}\"/>", g, g);
    return Document(text + "</junction>\n");
  }

  static std::string Head(int arm, int head) { return fmt::format("light{}.{}", arm, head); }
  static std::string ArmId(int arm) { return std::to_string(arm + 1); }
  // From an arm by so many quarter turns of the arms: 1 right, 2 straight, 3 left for traffic that keeps to the right.
  static std::string WayId(int from, int turn) { return std::to_string(100 + 10 * from + turn); }
  int InLane(int arm) const { return outward[static_cast<std::size_t>(arm)] ? 1 : -1; }

 private:
  std::string Light(int arm, int head, bool as_reference) const {
    const bool out = outward[static_cast<std::size_t>(arm)];
    const std::string with = out ? "-" : "+", against = out ? "+" : "-";
    const std::string side = orientation == Orientation::kNone    ? "none"
                             : orientation == Orientation::kFaced ? against
                                                                  : with;
    const double s = (out ? kLight_m : kArm_m - kLight_m) + (out ? 0.2 : -0.2) * head;
    const int lane = InLane(arm);
    std::string lanes;
    if (validity) lanes = fmt::format("<validity fromLane=\"{}\" toLane=\"{}\"/>", lane, lane);
    if (validity && validity_turned)  // the other one of these is no lane
      lanes = fmt::format("<validity fromLane=\"{}\" toLane=\"{}\"/>", lane > 0 ? 2 : -1, lane > 0 ? 1 : -2);
    if (as_reference)
      return fmt::format("<signalReference s=\"{}\" t=\"{}\" id=\"{}\" orientation=\"{}\">{}</signalReference>", s,
                         5.0 * lane, Head(arm, head), side, lanes);
    return fmt::format(
        "<signal id=\"{}\" name=\"light\" s=\"{}\" t=\"{}\" zOffset=\"3\" orientation=\"{}\" dynamic=\"yes\" "
        "country=\"OpenDRIVE\" type=\"1000001\" subtype=\"-1\" height=\"0.9\" width=\"0.3\">{}</signal>",
        Head(arm, head), s, 5.0 * lane, side, lanes);
  }

  std::string Arm(int arm) const {
    const bool out = outward[static_cast<std::size_t>(arm)];
    const double angle = 0.5 * std::numbers::pi * arm, far = kHalf_m + (out ? 0.0 : kArm_m);
    RoadText road;
    road.id = ArmId(arm), road.length = kArm_m;
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>",
                    far * std::cos(angle), far * std::sin(angle), out ? angle : angle + std::numbers::pi, kArm_m);
    road.link = fmt::format("<{} elementType=\"junction\" elementId=\"9\"/>", out ? "predecessor" : "successor");
    road.more = "<signals>";
    for (int of = 0; of < 4; ++of) {
      for (int head = 0; head < heads; ++head) {
        if (referenced && arm == 0) {
          // A signal that stands on the first arm, and holds there only for that arm's lane.
          road.more += of == 0 ? Light(0, head, false) : Elsewhere(of, head);
        } else if (of == arm) {
          road.more += Light(arm, head, referenced);
        }
      }
    }
    road.more += "</signals>\n";
    return road.Text();
  }

  // A signal of another arm that holds for no lane of the first one.
  static std::string Elsewhere(int of, int head) {
    return fmt::format(
        "<signal id=\"{}\" name=\"light\" s=\"75\" t=\"9\" zOffset=\"3\" orientation=\"none\" dynamic=\"yes\" "
        "country=\"OpenDRIVE\" type=\"1000001\" subtype=\"-1\" height=\"0.9\" width=\"0.3\"><validity fromLane=\"7\" "
        "toLane=\"7\"/></signal>",
        Head(of, head));
  }

  std::string Way(int from, int turn, std::string& connections) const {
    const int to = (from + turn) % 4;
    const double angle = 0.5 * std::numbers::pi * from, quarter = 0.5 * std::numbers::pi;
    RoadText road;
    road.id = WayId(from, turn);
    road.attributes = "junction=\"9\"";
    std::string shape = "<line/>";
    road.length = 2.0 * kHalf_m;
    if (turn != 2) {
      road.length = quarter * kHalf_m;
      shape = fmt::format("<arc curvature=\"{}\"/>", (turn == 1 ? -1.0 : 1.0) / kHalf_m);
    }
    // Arms are counted to the left: the next one, seen by traffic that arrives, is on its right.
    road.geometry =
        fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">{}</geometry>",
                    kHalf_m * std::cos(angle), kHalf_m * std::sin(angle), angle + std::numbers::pi, road.length, shape);
    const auto contact = [&](int arm) { return outward[static_cast<std::size_t>(arm)] ? "start" : "end"; };
    road.link = fmt::format(
        "<predecessor elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/><successor elementType=\"road\" "
        "elementId=\"{}\" contactPoint=\"{}\"/>",
        ArmId(from), contact(from), ArmId(to), contact(to));
    road.left = "";
    road.right = fmt::format(
        "<lane id=\"-1\" type=\"driving\"><link><predecessor id=\"{}\"/><successor id=\"{}\"/></link><width "
        "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
        InLane(from), -InLane(to));
    connections += fmt::format(
        "<connection id=\"{}\" incomingRoad=\"{}\" connectingRoad=\"{}\" contactPoint=\"start\"><laneLink "
        "from=\"{}\" to=\"-1\"/></connection>\n",
        road.id, ArmId(from), road.id, InLane(from));
    return road.Text();
  }
};

}  // namespace rodeira::opendrive

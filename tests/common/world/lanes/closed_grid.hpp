// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "common/world/traffic_map/map_network.hpp"

// A closed town of count × count crossings, streets of 200 m, priority to the right, no way out: its cars stay
// there.
namespace rodeira::lanes {

class ClosedGrid {
 public:
  // Lanes of the streets, from node to node: two of each street.
  static double Lanes_km(int count) { return 1e-3 * 4.0 * count * (count - 1) * kStreet_m; }

  // lit: every crossing has a light, 20 s of green each way.
  static std::shared_ptr<const network::Network> Make(int count, bool lit = false) {
    ClosedGrid grid;
    grid.Lay(count);
    const auto heights =
        traffic_map::ParseHeights("rodeira: motors/1\n" + (lit ? "lights:\n" + grid.lights_ : ""), "grid.motors.yaml");
    RODEIRA_ASSERT(heights.ok());
    const auto file = traffic_map::ParseMap(grid.text_ + grid.lanes_ + grid.connections_ + "s,10\ni\n", "grid.motors");
    RODEIRA_ASSERT(file.ok());
    auto lanes = traffic_map::MakeLaneMap(file.value(), lit ? heights.value() : traffic_map::Heights(), "grid");
    RODEIRA_ASSERT(lanes.ok());
    // A map's file has a start and an end lane, and there vehicles would come and go.
    for (traffic_map::MapLane& lane : lanes.value().lanes) lane.mode = traffic_map::LaneMode::kNone;
    const auto network = traffic_map::ToNetwork(lanes.value(), "grid");
    RODEIRA_ASSERT(network.ok());
    return network.value();
  }

 private:
  static constexpr double kStreet_m = 200.0, kReach_m = 14.0, kLane_m = 3.25;
  struct Pose {
    double x, y, heading;
    Pose Moved(double ahead, double left) const {
      const double c = std::cos(heading), s = std::sin(heading);
      return {x + ahead * c - left * s, y + ahead * s + left * c, heading};
    }
  };
  struct Arm {
    double angle;
    int arrives, leaves;
  };

  // On the right-hand lane of an arm, so far from the node, driving away from it or to it.
  static Pose Away(double x, double y, double angle, double far_m) {
    return Pose{x, y, angle}.Moved(far_m, -0.5 * kLane_m);
  }
  static Pose Towards(double x, double y, double angle, double far_m) {
    return Pose{x, y, angle + std::numbers::pi}.Moved(-far_m, -0.5 * kLane_m);
  }

  int Curve(const Pose& a, const Pose& b) {
    const double turn = std::remainder(b.heading - a.heading, 2.0 * std::numbers::pi),
                 chord = std::hypot(b.x - a.x, b.y - a.y);
    const double handle = std::fabs(turn) < 1e-6 ? chord / 3.0
                                                 : 4.0 / 3.0 * std::tan(std::fabs(turn) / 4.0) * chord /
                                                       (2.0 * std::sin(std::fabs(turn) / 2.0));
    text_ += fmt::format("p,{}", ++curves_);
    for (const Pose& p : {a, a.Moved(handle, 0.0), b.Moved(-handle, 0.0), b})
      text_ += fmt::format(",{:.3f},0,{:.3f}", p.x, p.y);
    text_ += "\n";
    return curves_;
  }
  int Lane(const Pose& a, const Pose& b) {
    const int left = Curve(a.Moved(0.0, 0.5 * kLane_m), b.Moved(0.0, 0.5 * kLane_m)),
              right = Curve(a.Moved(0.0, -0.5 * kLane_m), b.Moved(0.0, -0.5 * kLane_m));
    ++count_;
    lanes_ += fmt::format("l,{},{},False,0,{},False,0,{}\n", count_, left, right, count_ <= 2 ? count_ : 0);
    return count_;
  }
  void Lay(int count) {
    std::vector<std::vector<Arm>> arms(static_cast<std::size_t>(count * count));
    const auto at = [&](int x, int y) -> std::vector<Arm>& { return arms[static_cast<std::size_t>(x * count + y)]; };
    for (int x = 0; x < count; ++x) {
      for (int y = 0; y < count; ++y) {
        for (const bool east : {true, false}) {
          const int ox = x + (east ? 1 : 0), oy = y + (east ? 0 : 1);
          if (ox >= count || oy >= count) continue;
          const double angle = east ? 0.0 : 0.5 * std::numbers::pi, back = angle + std::numbers::pi;
          const int there = Lane(Away(kStreet_m * x, kStreet_m * y, angle, kReach_m),
                                 Away(kStreet_m * x, kStreet_m * y, angle, kStreet_m - kReach_m));
          const int here = Lane(Away(kStreet_m * ox, kStreet_m * oy, back, kReach_m),
                                Away(kStreet_m * ox, kStreet_m * oy, back, kStreet_m - kReach_m));
          at(x, y).push_back({angle, here, there});
          at(ox, oy).push_back({back, there, here});
        }
      }
    }
    for (int x = 0; x < count; ++x) {
      for (int y = 0; y < count; ++y) {
        std::vector<int> along, across;
        for (const Arm& arm : at(x, y)) (std::fabs(std::sin(arm.angle)) < 0.5 ? along : across).push_back(arm.arrives);
        lights_ += fmt::format("  - {{phases: [{{green: [{}], for_s: 20}}, {{green: [{}], for_s: 20}}]}}\n",
                               fmt::join(along, ", "), fmt::join(across, ", "));
        for (const Arm& from : at(x, y)) {
          for (const Arm& to : at(x, y)) {
            if (from.leaves == to.leaves) continue;
            const int turn = Lane(Towards(kStreet_m * x, kStreet_m * y, from.angle, kReach_m),
                                  Away(kStreet_m * x, kStreet_m * y, to.angle, kReach_m));
            connections_ +=
                fmt::format("c,{},{},False,0,0,0\nc,{},{},False,0,0,0\n", from.arrives, turn, turn, to.leaves);
          }
        }
      }
    }
  }

  std::string text_, lanes_, connections_, lights_;
  int curves_ = 0, count_ = 0;
};

}  // namespace rodeira::lanes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/ring.hpp"

namespace rodeira::traffic {

inline constexpr double kRadius_m = 600.0, kWidth_m = 3.5, kLimit_mps = 20.0, kRound = 2.0 * std::numbers::pi;
inline constexpr double kNoOncoming_s = 1e9;

// A road of one lane a direction around a circle, with these marks in its middle.
inline std::shared_ptr<const network::Network> TwoWayRing(const std::string& marks, bool left_hand = false,
                                                          const std::string& more = "") {
  opendrive::RoadText road = CircleRoad(kRound * kRadius_m, left_hand);
  road.left = CircleLane(1, kLimit_mps), road.right = CircleLane(-1, kLimit_mps);
  road.more = more;
  std::string text = road.Text();
  const std::string none = "<lane id=\"0\" type=\"none\"/>";
  text.replace(text.find(none), none.size(), "<lane id=\"0\" type=\"none\">" + marks + "</lane>");
  return opendrive::MustRead(opendrive::Document(text));
}

// What the poses on that ring say: which are over the middle, pass, and touch.
class RingWatch {
 public:
  explicit RingWatch(bool left_hand = false) : left_hand_(left_hand) {}

  struct Car {
    double s_m = 0.0;      // along the road's middle
    double aside_m = 0.0;  // farthest that it reaches over the middle, above 0 on the other side
    bool with = false;     // drives with growing s
    double speed_mps = 0.0, length_m = 0.0;
  };
  struct Crossing {
    std::uint32_t id;
    bool with;
    double from_m, to_m;             // along the road, where it was over the middle
    double spare_s = kNoOncoming_s;  // until the oncoming one was where it then was, at the end
    double length_s = 0.0;
  };

  void Observe(const TrafficModel& model, double time_s) {
    std::map<std::uint32_t, Car> cars;
    for (const AgentPose& pose : model.poses()) cars[pose.id] = CarOf(model, pose);
    for (const auto& [id, car] : cars) {
      const bool over = car.aside_m > 0.0;
      const auto out = out_.find(id);
      if (over && out == out_.end()) out_[id] = {car.s_m, time_s};
      if (over || out == out_.end()) continue;
      Crossing crossing{id, car.with, out->second.s_m, car.s_m, kNoOncoming_s, time_s - out->second.time_s};
      for (const auto& [other, comes] : cars) {
        if (comes.with == car.with) continue;
        double gap = std::remainder((comes.s_m - car.s_m) * (car.with ? 1.0 : -1.0), kRound * kRadius_m) -
                     0.5 * (car.length_m + comes.length_m);
        if (gap > -car.length_m && comes.speed_mps > 0.1)
          crossing.spare_s = std::min(crossing.spare_s, std::max(0.0, gap) / comes.speed_mps);
      }
      crossings.push_back(crossing);
      out_.erase(out);
    }
    for (const auto& [a, one] : cars) {
      for (const auto& [b, two] : cars) {
        if (a >= b || std::fabs(std::remainder(one.s_m - two.s_m, kRound * kRadius_m)) > 15.0) continue;
        if (driver::Overlap(Rectangle(model, a), Rectangle(model, b))) touches.insert({a, b});
      }
    }
    if (!before_.empty()) {
      for (const auto& [id, car] : cars) {
        for (const auto& [other, slow] : cars) {
          if (id == other || car.with != slow.with) continue;
          const double sign = car.with ? 1.0 : -1.0;
          const double was = sign * std::remainder(before_[id].s_m - before_[other].s_m, kRound * kRadius_m),
                       is = sign * std::remainder(car.s_m - slow.s_m, kRound * kRadius_m);
          if (was < 0.0 && is >= 0.0 && is < 20.0) ++passes, passed_by[other].insert(id);
        }
      }
    }
    before_ = cars;
  }

  std::vector<Crossing> crossings;
  std::map<std::uint32_t, std::set<std::uint32_t>> passed_by;
  std::set<std::pair<std::uint32_t, std::uint32_t>> touches;
  int passes = 0;
  const std::map<std::uint32_t, Car>& cars() const { return before_; }
  std::size_t out_now() const { return out_.size(); }

 private:
  static driver::Footprint Rectangle(const TrafficModel& model, std::uint32_t id) {
    const auto& poses = model.poses();
    return FootprintOf(*std::find_if(poses.begin(), poses.end(), [&](const AgentPose& p) { return p.id == id; }),
                       model.traits(id));
  }
  Car CarOf(const TrafficModel& model, const AgentPose& pose) const {
    const AgentTraits& traits = model.traits(pose.id);
    const driver::Footprint body = FootprintOf(pose, traits);
    Car car;
    const double angle = std::atan2(body.x_m, kRadius_m - body.y_m);
    car.s_m = (angle < 0.0 ? angle + kRound : angle) * kRadius_m;
    car.with = std::cos(body.heading_rad - angle) > 0.0;
    car.speed_mps = body.speed_mps, car.length_m = traits.length_m;
    const bool outside = car.with != left_hand_;  // its own side
    car.aside_m = -1e9;
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const double c = std::cos(body.heading_rad), s = std::sin(body.heading_rad);
        const double px = body.x_m + x * traits.length_m * c - y * traits.width_m * s,
                     py = body.y_m + x * traits.length_m * s + y * traits.width_m * c;
        const double r = std::hypot(px, py - kRadius_m);
        car.aside_m = std::max(car.aside_m, outside ? kRadius_m - r : r - kRadius_m);
      }
    }
    return car;
  }

  struct Out {
    double s_m, time_s;
  };
  bool left_hand_;
  std::map<std::uint32_t, Out> out_;
  std::map<std::uint32_t, Car> before_;
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/driving/driver/footprint.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// How long any vehicle stands before a crossing, first at its line, while there is room at the exit that it takes: told
// by the published poses and the lanes alone, apart from what drivers take for room. Streets are the tracks that are
// not short; an exit is the next street on a way; there is room on it while no rectangle lies on its first metres, as
// many as the car needs to stand there clear of others that come into it. Which exit it takes is what it does later; of
// one that still stands in the end any counts.
class ExitRoom {
 public:
  ExitRoom(const lanes::Graph& graph, std::size_t vehicles, double look_s)
      : graph_(&graph), look_s_(look_s), cars_(vehicles), exits_(graph.tracks().size()) {
    for (std::uint32_t track = 0; track < exits_.size(); ++track) {
      if (IsStreet(track)) FindExits(track, track);
    }
  }

  // Every look_s.
  void Observe(const TrafficModel& model) {
    std::vector<std::int64_t> on(cars_.size(), -1);
    std::vector<double> at(cars_.size(), 0.0);
    std::map<std::uint32_t, double> farthest;  // middle of the first on a street
    bodies_.clear();
    for (const AgentPose& pose : model.poses()) {
      bodies_.push_back(FootprintOf(pose, model.traits(pose.id)));
      double nearest = 1.0;
      for (const lanes::Graph::Beside& beside : graph_->TracksAt(pose.p_WB_W.head<2>(), nearest)) {
        const lanes::Track& track = (*graph_)[beside.track];
        if (track.lane.road != static_cast<std::uint32_t>(pose.road) || track.lane.lane != pose.lane ||
            std::fabs(beside.foot.offset_m) >= nearest)
          continue;
        nearest = std::fabs(beside.foot.offset_m);
        on[pose.id] = beside.track, at[pose.id] = beside.foot.d_m;
      }
      if (on[pose.id] < 0) continue;
      auto [first, is_new] = farthest.try_emplace(static_cast<std::uint32_t>(on[pose.id]), at[pose.id]);
      first->second = std::max(first->second, at[pose.id]);
    }
    for (const AgentPose& pose : model.poses()) {
      if (on[pose.id] < 0) continue;
      const auto track = static_cast<std::uint32_t>(on[pose.id]);
      Car& car = cars_[pose.id];
      if (IsStreet(track) && car.street != track) {
        if (const auto taken = car.longest_s.find(track); taken != car.longest_s.end()) Take(pose.id, taken->second);
        car = {track, {}, {}};
      }
      if (car.street != track) continue;
      if (pose.speed_mps > kAtRest_mps)
        car.stands_s.clear();
      else if (at[pose.id] >= farthest.at(track))
        Stand(car, model.traits(pose.id).length_m);
    }
  }

  double longest_s() const { return longest_s_; }
  std::uint32_t longest_id() const { return longest_id_; }
  // In the end, once.
  void End() {
    for (std::uint32_t id = 0; id < cars_.size(); ++id) {
      for (const auto& [exit, stood_s] : cars_[id].stands_s) Take(id, stood_s);
    }
  }

 private:
  static constexpr double kStreet_m = 50.0, kAtRest_mps = 0.05, kEvery_m = 0.5;
  static constexpr double
      kShared_m = 3.0,
      kGap_m = 2.5;  // ways into a street are one from so far on; before and behind the one that stands there

  struct Car {
    std::uint32_t street = 0xFFFFFFFF;
    std::map<std::uint32_t, double> stands_s, longest_s;  // by exit: of this stand, of any before this crossing
  };

  bool IsStreet(std::uint32_t track) const { return (*graph_)[track].length_m() >= kStreet_m; }

  void FindExits(std::uint32_t street, std::uint32_t from) {
    for (const lanes::Link& link : (*graph_)[from].next) {
      if (IsStreet(link.to))
        exits_[street].push_back(link.to);
      else
        FindExits(street, link.to);
    }
  }

  void Stand(Car& car, double length_m) {
    for (const std::uint32_t exit : exits_[car.street]) {
      if (!HasRoom(exit, kShared_m + length_m + kGap_m)) continue;
      double& longest = car.longest_s[exit];
      longest = std::max(longest, car.stands_s[exit] += look_s_);
    }
  }

  bool HasRoom(std::uint32_t exit, double to_m) const {
    for (double d = 0.0; d <= to_m; d += kEvery_m) {
      const lanes::CurvePoint point = (*graph_)[exit].curve.At(d);
      const driver::Footprint spot{0,   point.p_W.x(), point.p_W.y(), std::atan2(point.ahead_W.y(), point.ahead_W.x()),
                                   0.0, kEvery_m,      kEvery_m};
      for (const driver::Footprint& body : bodies_) {
        if (std::hypot(body.x_m - spot.x_m, body.y_m - spot.y_m) < body.length_m && driver::Overlap(body, spot))
          return false;
      }
    }
    return true;
  }

  void Take(std::uint32_t id, double stood_s) {
    if (stood_s > longest_s_) longest_s_ = stood_s, longest_id_ = id;
  }

  const lanes::Graph* graph_;
  double look_s_;
  std::vector<Car> cars_;
  std::vector<std::vector<std::uint32_t>> exits_;  // by track
  std::vector<driver::Footprint> bodies_;
  double longest_s_ = 0.0;
  std::uint32_t longest_id_ = 0;
};

}  // namespace rodeira::traffic

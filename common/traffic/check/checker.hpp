// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/traffic/check/box_check.hpp"
#include "common/traffic/check/incidents.hpp"
#include "common/traffic/check/red_check.hpp"
#include "common/traffic/check/road_check.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// What the checks have found, since the beginning.
struct CheckCounts {
  std::int64_t collisions = 0;  // times that two boxes on one level came to overlap
  std::int64_t reds = 0;        // times that a front passed a red light
  std::int64_t off_lane = 0;    // times that a middle was seen beside every drivable lane
  std::int64_t wheels_off = 0;  // times that a wheel was seen beside everything that is there for vehicles
};

// The phase of a study that looks for faults in the published poses. It changes nothing of the model.
class Checker {
 public:
  explicit Checker(const TrafficModel& model);

  // Once every so often, after a step.
  void Observe(const TrafficModel& model, double time_s, Incidents& incidents);
  const CheckCounts& counts() const { return counts_; }

 private:
  void FindBodies(const TrafficModel& model);
  void Contacts(const TrafficModel& model, double time_s, Incidents& incidents);

  std::vector<BodySize> bodies_;          // by vehicle, of its trip
  std::vector<std::int64_t> trips_;       // by vehicle: that of its body; below 0: none
  std::vector<BoxCheck::Pair> touching_;  // in the last look, ascending
  BoxCheck boxes_;
  RoadCheck road_;
  RedCheck reds_;
  CheckCounts counts_;
};

}  // namespace rodeira::traffic

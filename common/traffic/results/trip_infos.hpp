// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// Trip information as SUMO's tools read it: <tripinfos>, a <tripinfo> a trip that began and ended within the run, in
// the order of their ends. Times in s, ways in m, speeds in m/s. Ids and lanes are those of the floating car data;
// positions are those of the front on its lane. A vehicle waits where it is slower than 0.1 m/s. `timeLoss` is against
// the free speed of each place that its driver would drive. `departDelay` is -1: not known.
class TripInfos {
 public:
  // The XML before the first trip, and behind the last one.
  static std::string Begin();
  static std::string End();
  // Looks at all vehicles at a moment, in ascending time. Returns the trips that have ended since the last one.
  std::string At(double time_s, const TrafficModel& model);

 private:
  struct Place {
    double time_s = 0.0, odometer_m = 0.0, front_m = 0.0, speed_mps = 0.0;
    std::uint32_t track = 0;
  };
  struct Trip {
    bool is_there = false, is_whole = false;  // on the road; it began within the run
    std::uint32_t number = 0;
    Place depart, last;
    double waiting_s = 0.0, loss_s = 0.0;
    int waits = 0;
  };
  void Write(std::string& text, double time_s, const TrafficModel& model, std::uint32_t id) const;

  std::vector<Trip> trips_;  // by vehicle
  bool began_ = false;
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/analysis/measures/measure.hpp"

namespace rodeira::measures {

// Which times beyond a line count.
struct DepartureOptions {
  double hysteresis_m = 0.1;    // a departure ends where the part is again so far inside the line
  double min_duration_s = 0.2;  // shorter ones do not count
};

// A time in which a part of the vehicle is beyond a line.
struct Departure {
  std::size_t from = 0, to = 0;  // samples [from, to) from the crossing outward to the crossing back
  double greatest_m = 0.0;       // farthest beyond the line
  double area_ms = 0.0;          // integral of the distance beyond the line, m s
  bool intended = false;         // an indicator was on at its beginning, or it belongs to a lane change
  bool open = false;             // it lasts to the end of the series
};

// The departures over one line. inside_m: distance of the part from the line, positive inside the lane; missing samples
// end a departure. intended: not 0 where a departure that begins there is meant; may be empty.
std::vector<Departure> Departures(Series inside_m, double rate_hz, const DepartureOptions& options,
                                  std::span<const std::uint8_t> intended = {});

// Of one line, or of both, their departures one list: number, share of time, area (m s), greatest distance. inside_m:
// distance from the nearer line; it says how many samples are valid.
Measure DepartureCount(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options);
Measure DepartureShare(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options);
Measure DepartureArea(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options);
Measure DepartureGreatest(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options);

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace rodeira::cli {

// `rodeira traffic run MAP --vehicles N --for S [--driver standard|motors] [--physics planar|full] [--settings FILE]
// [--csv DIR [--every S]] [--rows-every S] [--warm S] [--heat FILE [--pixel M]] [--fcd FILE] [--tripinfo FILE]
// [--diagram FILE --lane ROAD:LANE]`
struct TrafficOptions {
  std::string map;  // a world file, .xodr or .motors
  std::optional<std::uint32_t>
      vehicles;  // as the settings say; without settings 50, or with flows at most 1000 at a time
  double duration_s = 60.0;
  double step_s = 0.01;
  std::uint64_t seed = 1;
  std::string driver;    // standard or motors; empty: as the settings say
  std::string physics;   // planar or full; empty: as the settings say
  std::string settings;  // a file of `rodeira: traffic/1`; empty: as usual
  std::string csv;       // folder; empty: no tables
  double warm_s = 0.0;   // tables and heat leave out so much of the beginning
  // Rows of trajectories.csv, floating car data and the diagram; none: 0.5, or the step where that is longer.
  std::optional<double> rows_every_s;
  double every_s = 0.0;   // rows of intervals.csv; 0: no such table
  std::string heat;       // .svg or .tif; empty: none
  double pixel_m = 1.0;   // of heat.tif
  std::string fcd;        // .xml; empty: none
  std::string tripinfo;   // .xml; empty: none
  std::string diagram;    // .svg; empty: none
  std::string lane;       // of the diagram, "ROAD:LANE"; empty: the longest one
  bool no_check = false;  // faults are not looked for
  bool quiet = false;
};

// The traffic model alone on a map's roads: no network, no other node. Status 2 where the map or an option is wrong.
int TrafficRun(const TrafficOptions& options);

// Seconds a row, as they are meant where none are said.
double RowsEvery_s(const TrafficOptions& options);

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/traffic/results/signal_table.hpp"
#include "common/traffic/results/study.hpp"
#include "common/traffic/results/trajectory_diagram.hpp"
#include "common/traffic/results/trip_infos.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"

namespace rodeira::cli {

// What `rodeira traffic run` writes: some of it moment by moment, the rest at the end.
class TrafficFiles {
 public:
  // Wrong input where an option is wrong, failed where a file cannot be begun.
  static base::Result<TrafficFiles> Open(const TrafficOptions& options, const network::Network& network);

  bool wants_cells() const { return !options_.csv.empty() || !options_.heat.empty(); }
  // Moments in ascending order of time. A disk that is full is told by Close.
  void Write(const traffic::StudyMoment& moment);
  // What was written, a path each.
  base::Result<std::vector<std::string>> Close(const network::Network& network, const traffic::StudyResult& result);

 private:
  explicit TrafficFiles(TrafficOptions options) : options_(std::move(options)) {}
  std::string InFolder(const char* name) const;
  void WriteTrajectories(const traffic::StudyMoment& moment);

  TrafficOptions options_;
  std::ofstream trajectories_, signals_, fcd_, tripinfo_;
  traffic::TripInfos trip_infos_;
  std::optional<traffic::SignalTable> signal_table_;
  std::optional<traffic::TrajectoryDiagram> diagram_;
  double next_s_ = 0.0;
};

}  // namespace rodeira::cli

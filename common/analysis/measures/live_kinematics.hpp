// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "common/analysis/measures/sample_kinematics.hpp"

namespace rodeira::measures {

// The kinematics of one sample of a run, as DriveBuilder makes them of a recording. Where lanes part, the way that the
// vehicle will take is not known yet: the leader is looked for on the first one of the next lanes. A sample depends on
// its own values alone, not on samples before.
class LiveKinematics {
 public:
  // network: null where there are no roads; what needs them is then missing. It must outlive this.
  explicit LiveKinematics(const network::Network* network);
  LiveKinematics(const LiveKinematics&) = delete;
  LiveKinematics& operator=(const LiveKinematics&) = delete;

  // front_m: from B's origin to the front bumper.
  void SetFootprint(double length_m, double front_m, double width_m);
  // A drive of one sample, valid until the next call. others: all other vehicles, without pedestrians.
  const Drive& At(const SubjectSample& subject, std::span<const OtherVehicle> others);

 private:
  std::optional<lanes::Graph> graph_;
  std::optional<LaneFinder> lanes_;
  std::optional<LeaderFinder> leaders_;
  network::Hint hint_;
  Drive drive_;
};

}  // namespace rodeira::measures

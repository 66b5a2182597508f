// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// The leaders of all vehicles in a step.
struct PastLeaders {
  struct Of {
    double gap_m = 0.0, speed_mps = 0.0;
    std::int64_t id = -1, body = -1;  // of an agent; of a vehicle that is none; both below 0: no leader
    std::int64_t trip = -1;           // below 0: it did not drive
  };
  std::int64_t time_ns = 0;
  std::vector<Of> of;  // by vehicle

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);
};

// Drivers that see their leader as it was `reaction_s` ago; in the first `reaction_s` of a trip, as it was at its
// beginning.
class Reaction {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const Agent> agents;
    const std::int64_t& time_ns;
    std::span<const Leader> ahead;
  };
  struct Writes {
    std::deque<PastLeaders>& past;  // the oldest first
    std::span<Leader> perceived;
  };
  Reaction(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // Once a step.
  void Perceive();

 private:
  void Note();

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

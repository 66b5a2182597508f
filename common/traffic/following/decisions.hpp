// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/following/acceleration.hpp"
#include "common/traffic/following/car_following.hpp"
#include "common/traffic/following/decided.hpp"
#include "common/traffic/following/speed_limits.hpp"
#include "common/traffic/perception/sight.hpp"
#include "common/traffic/right_of_way/passage.hpp"
#include "common/traffic/signals/signals.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/traffic_settings.hpp"

namespace rodeira::traffic {

// Drivers that decide on their acceleration every `decide_s`, each at a time of its own, and keep to it meanwhile. What
// cannot wait is decided in the step in which it is seen.
class Decisions {
 public:
  struct Reads {
    const TrafficSettings& settings;
    std::span<const AgentTraits> traits;
    const std::int64_t& time_ns;
    std::span<const RouteSegments> stretches;
    std::span<const std::vector<Block>> blocks;
    const bool& any_block;
    std::span<const std::vector<OncomingOvertaker>> facing;
    const bool& any_facing;
    std::span<const std::uint8_t> is_overtaken;
    std::span<const Leader> ahead;
    std::span<const ConflictPassage> passages;
    std::span<const double> leaves;
    std::span<const double> bars;
    const Acceleration& acceleration;
    const CarFollowing& following;
    const SpeedLimits& limits;
  };
  struct Writes {
    std::vector<Decided>& decided;
    std::span<Agent> agents;
    std::span<Leader> seen;  // without the reaction time
    Signals& signals;
  };
  Decisions(const Reads& reads, const Writes& writes) : in_(reads), out_(writes) {}

  // The acceleration that the driver wants, in a step in which all is looked for anew; the next such one is so much
  // later.
  double Wanted(std::uint32_t id, std::int64_t step_ns);
  // In the steps between: first its leader of the last such step as that one is now …
  void KeepLeader(std::uint32_t id);
  // ... then what it wanted at that step or, where that is less, what its leader, a changed light or a command allows.
  double Kept(std::uint32_t id);

 private:
  bool MayKeep(std::uint32_t id, std::int64_t step_ns) const;
  bool IsManoeuvring(std::uint32_t id) const;
  bool SeesOthers(std::uint32_t id) const;
  bool IsPressed(std::uint32_t id) const;
  double BehindLeader(std::uint32_t id) const;
  void NoteLeader(std::uint32_t id);

  Reads in_;
  Writes out_;
};

}  // namespace rodeira::traffic

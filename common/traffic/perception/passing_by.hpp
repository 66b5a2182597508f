// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "common/traffic/perception/sight.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/vehicle_way.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

inline constexpr double kStandingLeader_mps = 0.5;  // a slower leader counts as stationary
inline constexpr double kPassingBy_m = 0.3;         // between the sides of two vehicles
inline constexpr double kPassingStep_m = 1.0;       // between two places that are checked
inline constexpr double kSlowBody_mps = 5.0;        // a slower vehicle outside of the traffic model may soon stop
inline constexpr double kBodyBrakes_mps2 = 6.0;     // … with at most this deceleration
inline constexpr double kRoomToGoRound_m = 9.5;     // gap to a stationary obstacle, to drive around it …
inline constexpr double kRoomBraking_mps2 = 3.0;    // … kept by braking this hard

// The least stopping distance of a vehicle outside of the traffic model.
inline double StopsAfter_m(double speed_mps) { return std::max(0.0, speed_mps) * speed_mps / (2.0 * kBodyBrakes_mps2); }

// The part of a gap that a vehicle drives until it meets an oncoming one; the whole gap if that is stationary.
inline double MeetsAfter_m(double gap_m, double speed_mps, double other_mps) {
  return other_mps > -kStandingLeader_mps ? gap_m : gap_m * speed_mps / (speed_mps - other_mps);
}

// Whether a vehicle that changes lanes passes beside a leader that stands on the lane that it leaves. The leader's gap
// is from the front bumper along the path; its sides are from the middle of that lane.
inline bool PassesBeside(const lanes::Graph& graph, const Agent& agent, const AgentTraits& traits,
                         const Leader& leader) {
  const double half = 0.5 * traits.length_m, rear = FrontOf(agent, traits) + leader.gap_m,
               front = rear + leader.length_m;
  const double reaches = agent.change.side > 0 ? leader.left_m : -leader.right_m;
  for (double o = std::max(agent.o_m, rear - half); o <= std::min(front + half, agent.change.to_m);
       o += kPassingStep_m) {
    if (o < agent.change.from_m) return false;
    const PathFrame frame = FrameAt(graph, agent.path, o);
    const double gone = std::fabs(PieceAt(agent.path, o).offset_m) - std::fabs(frame.offset_m);
    const double least = gone + std::fabs(frame.slope) * (std::max(rear, o - half) - o);
    if (least - 0.5 * traits.width_m < reaches + kPassingBy_m) return false;
  }
  return true;
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/segments.hpp"

#include <algorithm>

namespace rodeira::launch {
namespace {

constexpr std::uint32_t kSmallKib = 1024;    // controls, answers, grants, remarks; states of at most 1 MB
constexpr std::uint32_t kVehicleKib = 2048;  // a state each millisecond

// All traffic of a city in a sample, or samples of which nothing is known.
bool SendsLargeSamples(const NodeKind& kind) { return kind.name == "traffic" || kind.name == kExternalKind; }

std::uint32_t SegmentKibOf(const LaunchNode& node, const lockstep::RosterNode& in_roster) {
  constexpr std::uint32_t kFull = TransportSettings::kSegmentKib;
  if (SendsLargeSamples(*node.kind)) return kFull;
  // Outputs on request, as joint forces, are more than a car's state.
  if (in_roster.outputs.size() > node.kind->outputs.size()) return kFull;
  return node.kind->name == "vehicle" ? kVehicleKib : kSmallKib;
}

}  // namespace

std::uint32_t SegmentKibOf(const Launch& launch, std::span<const lockstep::NodeIndex> nodes) {
  const std::uint32_t most_kib = launch.transport_settings().segment_kib;
  // What is kept for a node that is started again is sent to it at once.
  if (most_kib > TransportSettings::kSegmentKib || launch.keeps_for_restarts()) return most_kib;
  std::uint32_t segment_kib = kSmallKib;
  for (const lockstep::NodeIndex node : nodes)
    segment_kib = std::max(segment_kib, SegmentKibOf(launch.node(node), launch.roster().node(node)));
  return std::min(segment_kib, most_kib);
}

}  // namespace rodeira::launch

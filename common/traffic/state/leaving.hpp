// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace rodeira::traffic {

// Why a vehicle has left the road.
enum class LeaveReason : std::uint8_t {
  kRouteEnd,     // all roads of its route are behind it
  kNetworkEnd,   // it has no route, and the network ends
  kRouteMissed,  // it did not reach a lane of its route, and the network ends
  kLaneEnd,      // its lane ends, while its route, or the lane beside, goes on
  kRemoved,      // a request has removed it
};
inline constexpr std::size_t kLeaveReasons = 5;

// A vehicle that has left the road in this step.
struct Leaver {
  std::uint32_t id = 0;
  LeaveReason reason = LeaveReason::kNetworkEnd;
};

}  // namespace rodeira::traffic

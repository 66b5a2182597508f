// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace rodeira::opendrive {

// The kinds of repairs. Each has a name that does not change ("road.ended"); docs/reference/road-repairs.md lists them.
enum class RepairKind {
  kNone,
  kCentreLaneAdded,
  kConnectingRoadDropped,
  kConnectionDropped,
  kContactTurned,
  kDuplicateDropped,
  kElementDropped,  // its name begins with the element: "signal.dropped"
  kGapBridged,
  kGapDriven,
  kGridIgnored,
  kHeaderIgnored,
  kIgnored,
  kJumpKept,
  kJumpSmoothed,
  kJunctionLeft,
  kJunctionsMerged,
  kKinkDriven,
  kKinkRounded,
  kLaneAdded,
  kLaneDropped,
  kLaneEnded,
  kLaneLinkDropped,
  kLengthSet,
  kLightRaised,
  kLightTurned,
  kLightsDark,
  kLinkDropped,
  kLinkFound,
  kLinkMoved,
  kLinksByLanes,
  kRangeSwapped,
  kReadAsLine,
  kRoadEnded,
  kRoadLeftOut,
  kRoadRenamed,
  kSectionDropped,
  kSorted,
  kStationMoved,
  kStepKept,
  kSurfaceCut,
  kValueReplaced,
  kVersionAssumed,
  kWidthDropped,
  kWidthZero,
};

// A kind and its name in reports.
struct RepairKindName {
  RepairKind kind;
  std::string_view name;
};
std::span<const RepairKindName> RepairKindNames();  // without kNone; ascending by name
std::string_view NameOf(RepairKind kind);           // empty for kNone

}  // namespace rodeira::opendrive

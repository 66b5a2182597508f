// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/repair_kind.hpp"

#include <algorithm>
#include <array>

namespace rodeira::opendrive {
namespace {

constexpr std::array kRepairKinds = {
    RepairKindName{RepairKind::kConnectingRoadDropped, "connection.road_dropped"},
    RepairKindName{RepairKind::kConnectionDropped, "connection.dropped"},
    RepairKindName{RepairKind::kLaneLinkDropped, "connection.lane_link_dropped"},
    RepairKindName{RepairKind::kLightsDark, "controller.dark"},
    RepairKindName{RepairKind::kElementDropped, "element.dropped"},
    RepairKindName{RepairKind::kDuplicateDropped, "element.duplicate_dropped"},
    RepairKindName{RepairKind::kIgnored, "element.ignored"},
    RepairKindName{RepairKind::kSorted, "element.sorted"},
    RepairKindName{RepairKind::kStationMoved, "element.station_moved"},
    RepairKindName{RepairKind::kValueReplaced, "element.value_replaced"},
    RepairKindName{RepairKind::kGapBridged, "geometry.gap_bridged"},
    RepairKindName{RepairKind::kKinkRounded, "geometry.kink_rounded"},
    RepairKindName{RepairKind::kRangeSwapped, "geometry.range_swapped"},
    RepairKindName{RepairKind::kReadAsLine, "geometry.read_as_line"},
    RepairKindName{RepairKind::kHeaderIgnored, "header.ignored"},
    RepairKindName{RepairKind::kVersionAssumed, "header.version_assumed"},
    RepairKindName{RepairKind::kGridIgnored, "junction.heights_ignored"},
    RepairKindName{RepairKind::kJunctionsMerged, "junction.merged"},
    RepairKindName{RepairKind::kLaneAdded, "lane.added"},
    RepairKindName{RepairKind::kCentreLaneAdded, "lane.centre_added"},
    RepairKindName{RepairKind::kLaneDropped, "lane.dropped"},
    RepairKindName{RepairKind::kLaneEnded, "lane.ended"},
    RepairKindName{RepairKind::kGapDriven, "lane.gap_driven"},
    RepairKindName{RepairKind::kJumpKept, "lane.jump_kept"},
    RepairKindName{RepairKind::kJumpSmoothed, "lane.jump_smoothed"},
    RepairKindName{RepairKind::kLinkDropped, "lane.link_dropped"},
    RepairKindName{RepairKind::kLinkFound, "lane.link_found"},
    RepairKindName{RepairKind::kLinkMoved, "lane.link_moved"},
    RepairKindName{RepairKind::kWidthDropped, "lane.width_dropped"},
    RepairKindName{RepairKind::kWidthZero, "lane.width_zero"},
    RepairKindName{RepairKind::kContactTurned, "road.contact_turned"},
    RepairKindName{RepairKind::kRoadEnded, "road.ended"},
    RepairKindName{RepairKind::kJunctionLeft, "road.junction_left"},
    RepairKindName{RepairKind::kKinkDriven, "road.kink_driven"},
    RepairKindName{RepairKind::kRoadLeftOut, "road.left_out"},
    RepairKindName{RepairKind::kLengthSet, "road.length_set"},
    RepairKindName{RepairKind::kLinksByLanes, "road.links_by_lanes"},
    RepairKindName{RepairKind::kRoadRenamed, "road.renamed"},
    RepairKindName{RepairKind::kSectionDropped, "section.dropped"},
    RepairKindName{RepairKind::kLightRaised, "signal.light_raised"},
    RepairKindName{RepairKind::kLightTurned, "signal.light_turned"},
    RepairKindName{RepairKind::kStepKept, "surface.step_kept"},
    RepairKindName{RepairKind::kSurfaceCut, "surface.cut"},
};

}  // namespace

std::span<const RepairKindName> RepairKindNames() { return kRepairKinds; }

std::string_view NameOf(RepairKind kind) {
  const auto found = std::find_if(kRepairKinds.begin(), kRepairKinds.end(),
                                  [&](const RepairKindName& each) { return each.kind == kind; });
  return found == kRepairKinds.end() ? std::string_view() : found->name;
}

}  // namespace rodeira::opendrive

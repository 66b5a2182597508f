// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/core/base/error_id.hpp"

namespace rodeira::opendrive {

// The id of an error that names this rule (Finding::rule): "opendrive." and the rule in lower case with '_' for '.',
// such as "opendrive.road_lane_roadmark" of "road.lane.roadMark". A part that is the name of an element or attribute is
// left out: "road.lane.width.first" has "opendrive.road_lane_first". A rule that is not listed has
// "opendrive.rule_broken".
base::ErrorId IdOfRule(std::string_view rule);

}  // namespace rodeira::opendrive

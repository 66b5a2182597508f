// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/design/context.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// 'section' of a road: its lanes with shoulders and verges, what they are made of, the slopes across, the earthwork,
// and the template's lines. Into one lane section; what has no width somewhere is a lane of width 0 there.
void ReadSection(const config::DeclaredMap& road, Context& context, double length_m, network::RoadSpec& spec);

// t of a lane's outer edge over s; lane 0: where the lanes of both sides meet. The lane must be there.
geometry::CubicTable EdgeOf(const network::RoadSpec& spec, int lane);

}  // namespace rodeira::design

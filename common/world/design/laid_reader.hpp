// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/design/context.hpp"
#include "common/world/network/laid.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// Reads a road's 'patches' and 'bumps'. Each is an object of the road too (`roadSurface`, its outline in road
// coordinates), for what only draws or exports it.
network::Laid ReadLaid(const config::DeclaredMap& road, const Context& context, double length_m,
                       network::RoadSpec& spec);

}  // namespace rodeira::design

#pragma once

#include "common/config/config.hpp"
#include "common/design/context.hpp"
#include "common/network/laid.hpp"
#include "common/network/road.hpp"

namespace rodeira::design {

// Reads a road's 'patches' and 'bumps'. Each is an object of the road too (`roadSurface`, its outline in road coordinates), for what
// only draws or exports it.
network::Laid ReadLaid(const config::Map& road, const Context& context, double length_m, network::RoadSpec& spec);

}  // namespace rodeira::design

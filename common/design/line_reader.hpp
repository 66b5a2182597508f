#pragma once

#include "common/config/config.hpp"
#include "common/network/road.hpp"

namespace rodeira::design {

// 'lines' of a road or of a template: what is painted along it. The road's lanes must be there already.
void ReadLines(const config::Map& map, double length_m, network::RoadSpec& spec);

}  // namespace rodeira::design

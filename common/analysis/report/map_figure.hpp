// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/analysis/measures/drive.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::report {

// The way of the vehicle from above, coloured by speed, on the driving lanes around it, as SVG; north is up.
// network may be null.
std::string MapSvg(const measures::Drive& drive, const network::Network* network);

}  // namespace rodeira::report

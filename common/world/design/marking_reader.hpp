// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/declared.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::design {

// 'markings' of a road: zebra crossings and stop lines, which become painted lines (so that SUELO knows them), and
// arrows, which become objects. The road's lanes must be there already.
void ReadMarkings(const config::DeclaredMap& road, double length_m, network::RoadSpec& spec);

}  // namespace rodeira::design

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/network/network.hpp"
#include "tests/common/world/network/file_oracle.hpp"

namespace rodeira::network {

// Asks both where points on and about the roads lie, RODEIRA_ORACLE_POINTS of them, half of them with a height where
// `heights`: the same road, lane, s, t and distance wherever the oracle's choice is not open, and that it seldom is.
void ExpectAgreement(const Network& network, const FileOracle& oracle, bool heights, const std::string& name);

}  // namespace rodeira::network

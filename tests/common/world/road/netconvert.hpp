// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::road {

bool HasNetconvert();

// A network's roads as the network itself calls them; ids that an export had to change are asked by those of what is
// read again.
std::vector<std::string> IdsOf(const network::Network& network);

// Has netconvert read `it.xodr` in the folder, without a complaint, and finds each road's edges with the length of its
// line, at least so many. `ids` are those of the file, by road.
void ExpectEveryEdge(const std::filesystem::path& folder, const network::Network& network,
                     const std::vector<std::string>& ids, int at_least);

// Of what ExpectEveryEdge wrote: each edge's lanes with their widths, and what leads where.
void ExpectEveryLane(const std::filesystem::path& folder, const network::Network& network,
                     const std::vector<std::string>& ids);
void ExpectEveryWay(const std::filesystem::path& folder, const network::Network& network,
                    const std::vector<std::string>& ids);

}  // namespace rodeira::road

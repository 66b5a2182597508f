// SPDX-License-Identifier: Apache-2.0
// OpenDRIVE: what is taken is a network that says where points lie, the same by its index and without it.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "common/world/network/placing.hpp"
#include "common/world/opendrive/import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto import = rodeira::opendrive::Read(std::string(reinterpret_cast<const char*>(data), size), "fuzz.xodr");
  if (!import || import.value().network == nullptr) return 0;
  const rodeira::network::Network& network = *import.value().network;
  for (const rodeira::network::Road& road : network.roads()) {
    const Eigen::Vector3d p = road.Surface(0.37 * road.length_m(), 0.7).p_W;
    if (!p.allFinite()) std::abort();
    const auto place = network.Locate(p.x(), p.y(), p.z()), slowly = network.LocateSlowly(p.x(), p.y(), p.z());
    if (place.has_value() != slowly.has_value() || (place && place->lane != slowly->lane)) std::abort();
  }
  (void)rodeira::network::PlaceFurniture(network);
  return 0;
}

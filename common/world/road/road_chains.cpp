// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/road_chains.hpp"

#include <algorithm>

namespace rodeira::road {
namespace {

// The way through a junction that is the road's own, and the part behind it.
const network::Road* WayAfter(const network::Network& network, const network::Road& part) {
  if (!part.spec().successor || !part.spec().successor->junction) return nullptr;
  for (const network::Road& way : network.roads()) {
    const network::RoadSpec& spec = way.spec();
    const bool own = spec.junction == part.spec().successor->id && spec.name == part.spec().name;
    if (own && spec.predecessor && spec.predecessor->id == part.id() && spec.successor) return &way;
  }
  return nullptr;
}

}  // namespace

std::pair<const network::Road*, double> RoadChain::At(const network::Network& network, double s_m) const {
  auto part =
      std::upper_bound(parts.begin() + 1, parts.end(), s_m, [](double s, const Part& p) { return s < p.from_s_m; }) - 1;
  return {&network.roads()[part->road], s_m - part->from_s_m};
}

std::string IdOf(const network::Network& network, const RoadChain& chain) {
  const std::string& first = network.roads()[chain.parts.front().road].id();
  return first.substr(0, first.find('/'));
}

std::optional<RoadChain> FindRoadOrChain(const network::Network& network, std::string_view name) {
  if (const auto road = network.FindRoad(name)) {
    const network::Road& found = network.roads()[*road];
    return RoadChain{found.id(), {{*road, 0.0}}, found.length_m()};
  }
  for (RoadChain& chain : ChainsOf(network)) {
    if (IdOf(network, chain) == name) return std::move(chain);
  }
  return std::nullopt;
}

std::vector<std::string> NamesOfRoads(const network::Network& network) {
  std::vector<std::string> names, parts;
  for (const RoadChain& chain : ChainsOf(network)) {
    names.push_back(IdOf(network, chain));
    for (const RoadChain::Part& part : chain.parts) {
      const network::Road& road = network.roads()[part.road];
      if (road.id() != names.back() && road.spec().junction.empty()) parts.push_back(road.id());
    }
  }
  names.insert(names.end(), parts.begin(), parts.end());
  return names;
}

std::vector<RoadChain> ChainsOf(const network::Network& network) {
  std::vector<RoadChain> chains;
  std::vector<bool> used(network.roads().size(), false);
  for (std::uint32_t i = 0; i < network.roads().size(); ++i) {
    if (used[i] || !network.roads()[i].spec().junction.empty()) continue;
    RoadChain chain;
    chain.name = network.roads()[i].spec().name.empty() ? network.roads()[i].id() : network.roads()[i].spec().name;
    const auto count = static_cast<std::uint32_t>(network.roads().size());
    std::uint32_t next = i;
    while (next < count && !used[next]) {
      used[next] = true;
      const network::Road& part = network.roads()[next];
      chain.parts.push_back({next, chain.length_m});
      chain.length_m += part.length_m();
      const network::Road* way = part.id().find('/') == std::string::npos ? nullptr : WayAfter(network, part);
      if (way == nullptr) break;
      chain.parts.push_back({network.FindRoad(way->id()).value_or(0), chain.length_m});
      chain.length_m += way->length_m();
      next = network.FindRoad(way->spec().successor->id).value_or(count);
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace rodeira::road

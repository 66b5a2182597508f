// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/decks.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::road {
namespace {

constexpr double kEvery_m = 1.0;  // no road is narrower
constexpr double kMore_m = 1.0;   // beside what is sampled

// How far under a place of a road the lowest other surface lies; 0 where none is more than a level lower.
double DropAt(const network::Network& network, const Eigen::Vector3d& p_W) {
  thread_local std::vector<network::Surfacing> surfaces;
  network.Surfaces(p_W.x(), p_W.y(), surfaces);
  double drop = 0.0;
  for (const network::Surfacing& other : surfaces) {
    if (other.place.lane.lane != 0) drop = std::max(drop, p_W.z() - other.place.z_m);
  }
  return drop > network::Network::kLevel_m ? drop : 0.0;
}

std::vector<Stretch> DecksOf(const network::Network& network, const network::Road& road) {
  std::vector<Stretch> decks;
  const int steps = std::max(1, static_cast<int>(std::ceil(road.length_m() / kEvery_m)));
  for (int i = 0; i <= steps; ++i) {
    const double s = road.length_m() * i / steps;
    double right, left, drop = 0.0;
    road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
    for (const double t : {right, 0.5 * (right + left), left})
      drop = std::max(drop, DropAt(network, road.Surface(s, t).p_W));
    if (drop == 0.0) continue;
    const double beside = drop / kBank + kMore_m;
    const Stretch deck{std::max(0.0, s - beside), std::min(road.length_m(), s + beside)};
    if (!decks.empty() && deck.from_s_m <= decks.back().to_s_m) {
      decks.back().from_s_m = std::min(decks.back().from_s_m, deck.from_s_m),
      decks.back().to_s_m = std::max(decks.back().to_s_m, deck.to_s_m);
      while (decks.size() > 1 && decks.back().from_s_m <= decks[decks.size() - 2].to_s_m) {
        decks[decks.size() - 2].to_s_m = std::max(decks[decks.size() - 2].to_s_m, decks.back().to_s_m);
        decks.pop_back();
      }
    } else {
      decks.push_back(deck);
    }
  }
  return decks;
}

}  // namespace

std::vector<std::vector<Stretch>> FindDecks(const network::Network& network) {
  std::vector<std::vector<Stretch>> decks(network.roads().size());
  for (std::size_t i = 0; i < decks.size(); ++i) decks[i] = DecksOf(network, network.roads()[i]);
  return decks;
}

std::vector<Stretch> StandingOn(const network::Road& road, const std::vector<Stretch>& decks) {
  std::vector<Stretch> standing;
  double from = 0.0;
  for (const Stretch& deck : decks) {
    if (deck.from_s_m > from) standing.push_back({from, deck.from_s_m});
    from = deck.to_s_m;
  }
  if (from < road.length_m() || decks.empty()) standing.push_back({from, road.length_m()});
  return standing;
}

}  // namespace rodeira::road

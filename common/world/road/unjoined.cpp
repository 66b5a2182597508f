// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/unjoined.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "common/world/road/places_across.hpp"
#include "common/world/road/station_names.hpp"

namespace rodeira::road {
namespace {

using network::End;
using network::LaneKey;
using network::Network;

constexpr double kMouth_m = 60.0;

// Which roads belong together, and where.
class Kin {
 public:
  explicit Kin(const Network& network)
      : network_(network), junctions_(network.roads().size()), links_(network.roads().size()) {
    for (std::uint32_t i = 0; i < network.roads().size(); ++i) {
      const network::RoadSpec& spec = network.roads()[i].spec();
      if (const auto own = network.FindJunction(spec.junction); own && !spec.junction.empty())
        junctions_[i].insert(*own);
      for (const auto* link : {&spec.predecessor, &spec.successor}) {
        if (!*link) continue;
        if ((*link)->junction) {
          if (const auto met = network.FindJunction((*link)->id)) junctions_[i].insert(*met);
        } else if (const auto road = network.FindRoad((*link)->id)) {
          links_[i].insert(*road), links_[*road].insert(i);
        }
      }
    }
    for (std::uint32_t j = 0; j < network.junctions().size(); ++j) {
      for (const network::JunctionConnection& connection : network.junctions()[j].connections) {
        for (const std::string* id : {&connection.incoming_road, &connection.connecting_road}) {
          if (const auto road = network.FindRoad(*id)) junctions_[*road].insert(j);
        }
      }
    }
  }

  bool Excused(std::uint32_t a, double a_s, std::uint32_t b, double b_s) const {
    std::vector<std::uint32_t> both;
    std::set_intersection(junctions_[a].begin(), junctions_[a].end(), junctions_[b].begin(), junctions_[b].end(),
                          std::back_inserter(both));
    const bool in_a = !network_.roads()[a].spec().junction.empty(), in_b = !network_.roads()[b].spec().junction.empty();
    if (!both.empty() && (in_a || in_b)) return true;
    return (!both.empty() || links_[a].contains(b)) && NearEnd(a, a_s) && NearEnd(b, b_s);
  }

 private:
  bool NearEnd(std::uint32_t road, double s) const {
    return std::min(s, network_.roads()[road].length_m() - s) < kMouth_m;
  }

  const Network& network_;
  std::vector<std::set<std::uint32_t>> junctions_, links_;
};

bool AtEnd(const network::Road& road, double s) { return std::min(s, road.length_m() - s) <= Network::kClosed_m; }

}  // namespace

std::vector<Overlap> FindOverlaps(const Network& network) {
  const Kin kin(network);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Overlap> found;
  std::vector<network::Surfacing> surfaces;
  for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
    const network::Road& road = network.roads()[index];
    for (const double s : StationsLookedAt(road)) {
      const auto section = static_cast<std::uint32_t>(road.SectionIndex(s));
      for (const double t : PlacesAcross(road, section, s)) {
        const Eigen::Vector3d p = road.Surface(s, t).p_W;
        network.Surfaces(p.x(), p.y(), surfaces);
        for (const network::Surfacing& other : surfaces) {
          const LaneKey& key = other.place.lane;
          const double apart = other.sample.p_W.z() - p.z();
          if (key.road == index || other.place.distance_m > 0.0 || key.lane == 0 ||
              !network::IsDrivable(network.Find(key)->type) || !(std::fabs(apart) < Network::kLevel_m))
            continue;
          if (kin.Excused(index, s, key.road, other.place.s_m)) continue;
          const bool meet = AtEnd(road, s) && AtEnd(network.roads()[key.road], other.place.s_m);
          const Overlap overlap = index < key.road ? Overlap{index, key.road, s, other.place.s_m, meet, apart}
                                                   : Overlap{key.road, index, other.place.s_m, s, meet, -apart};
          Overlap& first = found.try_emplace({overlap.road, overlap.other}, overlap).first->second;
          if (first.meet && !meet) first = overlap;
        }
      }
    }
  }
  std::vector<Overlap> overlaps;
  for (const auto& [pair, overlap] : found) overlaps.push_back(overlap);
  return overlaps;
}

std::vector<OfRoad> DescribeOverlaps(const Network& network, bool own) {
  const StationNames names(network, own);
  std::vector<OfRoad> said;
  for (const Overlap& overlap : FindOverlaps(network)) {
    said.push_back(
        {overlap.road,
         fmt::format("{} and {} {}, {:.2f} m apart in height, and neither a junction nor a link joins them there",
                     names.At(overlap.road, overlap.s_m), names.At(overlap.other, overlap.other_s_m),
                     overlap.meet ? "touch end to end" : "lie on one another", std::fabs(overlap.apart_m))});
  }
  return said;
}

}  // namespace rodeira::road

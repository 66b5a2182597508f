// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/passes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "common/core/ground/ground.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/places_across.hpp"

namespace rodeira::road {
namespace {

bool IsInside(const network::Structure& structure, double s_m) {
  return s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m;
}

}  // namespace

std::vector<Pass> FindPasses(const network::Network& network) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Pass> found;
  std::vector<network::Surfacing> surfaces;
  for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
    const network::Road& road = network.roads()[index];
    for (const double s : StationsLookedAt(road)) {
      if (IsExempt(road.spec(), s)) continue;
      for (const double t : PlacesAcross(road, static_cast<std::uint32_t>(road.SectionIndex(s)), s)) {
        const Eigen::Vector3d p = road.Surface(s, t).p_W;
        network.Surfaces(p.x(), p.y(), surfaces);
        for (const network::Surfacing& other : surfaces) {
          const network::LaneKey& key = other.place.lane;
          const double apart = p.z() - other.sample.p_W.z();
          if (other.place.distance_m > 0.0 || key.lane == 0 || !network::IsDrivable(network.Find(key)->type) ||
              apart < network::Network::kLevel_m)
            continue;
          if (IsExempt(network.roads()[key.road].spec(), other.place.s_m)) continue;
          found.try_emplace({index, key.road}, Pass{index, key.road, s, other.place.s_m, apart});
        }
      }
    }
  }
  std::vector<Pass> passes;
  for (const auto& [pair, pass] : found) passes.push_back(pass);
  return passes;
}

std::vector<OpenTunnel> FindOpenTunnels(const network::Network& network, const BareTerrain& terrain) {
  std::vector<OpenTunnel> open;
  for (std::uint32_t index = 0; index < network.roads().size(); ++index) {
    const network::Road& road = network.roads()[index];
    for (const network::Structure& structure : road.spec().structures) {
      if (structure.bridge) continue;
      std::optional<OpenTunnel> lowest;
      for (const double s : StationsLookedAt(road)) {
        if (!IsInside(structure, s)) continue;
        for (const double t : PlacesAcross(road, static_cast<std::uint32_t>(road.SectionIndex(s)), s)) {
          const Eigen::Vector3d p = road.Surface(s, t).p_W;
          const SurfacePoint ground = terrain.At(p.x(), p.y());
          const double hill_m = ground.z_m - p.z();
          if (!ground.inside || !(hill_m > 0.0) || hill_m > ground::kMaxAboveHint_m ||
              (lowest && lowest->hill_m <= hill_m))
            continue;
          lowest = OpenTunnel{index, structure.s_m, structure.s_m + structure.length_m, s, hill_m};
        }
      }
      if (lowest) open.push_back(*lowest);
    }
  }
  return open;
}

std::vector<OfRoad> DescribePasses(const network::Network& network, const BareTerrain& terrain) {
  const StationNames names(network, true);
  std::vector<OfRoad> said;
  for (const Pass& pass : FindPasses(network)) {
    said.push_back(
        {pass.over, fmt::format("{} lies {:.1f} m over {}, and neither has the upper one `bridges` there nor the lower "
                                "one `tunnels`: the ground rises from the one to the other",
                                names.At(pass.over, pass.over_s_m), pass.apart_m,
                                pass.over == pass.under
                                    ? fmt::format("itself at s = {:.1f} m", names.StationOf(pass.under, pass.under_s_m))
                                    : names.At(pass.under, pass.under_s_m))});
  }
  for (const OpenTunnel& tunnel : FindOpenTunnels(network, terrain)) {
    said.push_back(
        {tunnel.road,
         fmt::format(
             "the tunnel of {} from s = {:.1f} to {:.1f} m has the terrain only {:.2f} m over its road at s = {:.1f} "
             "m: what drives there drives on the terrain; a hill of some metres over all of it was expected",
             names.Road(tunnel.road), names.StationOf(tunnel.road, tunnel.from_s_m),
             names.StationOf(tunnel.road, tunnel.to_s_m), tunnel.hill_m, names.StationOf(tunnel.road, tunnel.s_m))});
  }
  return said;
}

}  // namespace rodeira::road

// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/tunnel_sides.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/network/cluster.hpp"

namespace rodeira::road {
namespace {

constexpr double kCluster_m =
    1.5 * network::BandIndex::kWidest_m;  // of a cluster's points from one another, and some more

}  // namespace

TunnelSides::TunnelSides(std::shared_ptr<const network::Network> network) : network_(std::move(network)) {
  std::vector<SquareLists::Strip> strips;
  for (std::uint32_t index = 0; index < network_->roads().size(); ++index) {
    const network::Road& road = network_->roads()[index];
    const std::vector<geometry::AxisPanel>& panels = road.axis().panels();
    for (const network::Structure& structure : road.spec().structures) {
      if (structure.bridge) continue;
      for (std::uint32_t i = 0; i < panels.size(); ++i) {
        const geometry::AxisPanel& panel = panels[i];
        const double from = std::max({structure.s_m, panel.begin_s_m(), 0.0}),
                     to = std::min({structure.s_m + structure.length_m, panel.end_s_m(), road.length_m()});
        if (!(to > from)) continue;
        parts_.push_back({index, i, {from, to}});
        strips.push_back({road.axis().At(panel, -panel.half_m).p_W, road.axis().At(panel, panel.half_m).p_W,
                          EdgesBeside(road, panel).beside_m + kBeside_m + kCluster_m});
      }
    }
  }
  near_ = SquareLists(strips);
}

std::optional<TunnelSides::Floor> TunnelSides::At(const Eigen::Vector2d& p_W) const {
  std::optional<Floor> floor;
  double nearest = kBeside_m;
  for (const std::uint32_t number : near_.At(p_W)) {
    const Part& part = parts_[number];
    const network::Road& road = network_->roads()[part.road];
    const EdgePlace place = PlaceOnEdge(road, road.axis().panels()[part.panel], part.stretch, p_W);
    // Where neighbouring parts meet in a kink that is closed, the place between them is both's.
    if (std::fabs(place.found_s_m - place.s_m) + place.beyond_m > network::Network::kClosed_m) continue;
    const double away = (p_W - place.sample.p_W.head<2>()).norm();
    if (away >= nearest) continue;
    nearest = away;
    floor = Floor{place.sample.p_W.z(), Eigen::Vector2d::Zero()};
    if (place.pace > 0.0)
      floor->slope_W =
          place.sample.ds_W.z() / place.pace * place.axis.tangent_W;  // the height goes along with the road's
  }
  return floor;
}

}  // namespace rodeira::road

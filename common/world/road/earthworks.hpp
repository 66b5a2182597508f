// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/world/design/junction_surface.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/road_edge.hpp"
#include "common/world/road/square_lists.hpp"
#include "common/world/road/surface_point.hpp"

namespace rodeira::road {

// Cut and fill. Every point q of a road's or a junction's edge holds the ground at p, d away from it, between
// z(q) - d / fill and z(q) + d / cut; the terrain is clamped between the greatest lower and the least upper of these
// bounds. So ground and road meet without a gap, and slopes end where they meet the terrain. Where a lower bound lies
// above an upper one (a high and a low road side by side) the ground goes from the one to the other by the distances
// from both. A road with a blend (network::Earthwork) is alone in its network: the ground within the blend's width is
// its surface, which goes on in its slopes, and the terrain, weighted by the distance from the verges' outline.
class Earthworks {
 public:
  Earthworks(std::shared_ptr<const network::Network> network,
             std::vector<std::shared_ptr<const design::JunctionSurface>> junctions);

  // Changes height and slopes of the terrain beside the roads.
  void Shape(const Eigen::Vector2d& p_W, SurfacePoint& ground) const;

 private:
  struct Bound {
    double z_m = 0.0, distance_m = 0.0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero(), away = Eigen::Vector2d::Zero();  // of z and of the distance
    bool any = false;
  };
  struct Bounds {
    Bound low, high;
  };
  struct Edge {  // a point of a road's edge, and how its height goes with p
    Eigen::Vector2d p_W;
    double z_m;
    Eigen::Vector2d along;
  };
  using Heights = EdgeHeights;
  struct Reach {  // of a panel's edges: all of them lie within beside_m of the way from one end to the other
    std::uint32_t road = 0, panel = 0;
    Eigen::Vector2d from_W, to_W;
    double beside_m = 0.0;
    Heights heights{};

    // At least so far from the edges a place is.
    double DistanceFrom(const Eigen::Vector2d& p_W) const {
      return std::max(0.0, SquareLists::Strip{from_W, to_W, 0.0}.FromWay(p_W) - beside_m);
    }
  };
  void AddReaches(std::uint32_t road);
  void Blend(std::span<const std::uint32_t> near, const Eigen::Vector2d& p_W, SurfacePoint& ground) const;
  // Whether an edge with these heights, at least so far away, may hold the ground more tightly than the bounds do
  // already.
  static bool MayTighten(const network::Earthwork& earthwork, const Heights& heights, double distance_m,
                         const Bounds& bounds);
  void FromRoad(const network::Road& road, std::uint32_t panel, const Eigen::Vector2d& p_W, Bounds& bounds) const;
  void FromRoads(std::span<const std::uint32_t> near, const Eigen::Vector2d& p_W, Bounds& bounds) const;
  void FromJunction(std::size_t junction, const Eigen::Vector2d& p_W, Bounds& bounds) const;
  static void Offer(const network::Earthwork& earthwork, const Edge& edge, const Eigen::Vector2d& p_W, Bounds& bounds);

  std::shared_ptr<const network::Network> network_;
  std::vector<std::shared_ptr<const design::JunctionSurface>> junctions_;
  bool blends_ = false;                             // the network's one road has a blend
  std::vector<Reach> reaches_;                      // of all panels of roads with slopes
  std::vector<std::vector<Heights>> edge_heights_;  // by junction and free edge
  std::vector<Heights> junction_heights_;           // of all of its edges
  SquareLists near_;                                // reaches_ with slopes that may be there, and behind them junctions
};

}  // namespace rodeira::road

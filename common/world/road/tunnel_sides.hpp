// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/road/road_edge.hpp"
#include "common/world/road/square_lists.hpp"

namespace rodeira::road {

// The floor of tunnels beside their roads: it goes on level across from the road's edge, so that a wheel that is
// pressed over it into the wall stands on the floor and not on the hill.
class TunnelSides {
 public:
  static constexpr double kBeside_m = 5.0;  // so far it goes on

  // Height and gradient (dz/dx, dz/dy) of the floor.
  struct Floor {
    double z_m = 0.0;
    Eigen::Vector2d slope_W = Eigen::Vector2d::Zero();
  };

  explicit TunnelSides(std::shared_ptr<const network::Network> network);

  // False: none is here, nor at any point of a cluster (network::Cluster) that holds this one.
  bool MayHold(const Eigen::Vector2d& p_W) const { return !near_.At(p_W).empty(); }
  // Of the nearest of the tunnels; on its road it is the road's own height. Nothing before their mouths and farther
  // away.
  std::optional<Floor> At(const Eigen::Vector2d& p_W) const;

 private:
  struct Part {  // of a tunnel, on one panel of its road
    std::uint32_t road = 0, panel = 0;
    Stretch stretch;
  };

  std::shared_ptr<const network::Network> network_;
  std::vector<Part> parts_;
  SquareLists near_;
};

}  // namespace rodeira::road

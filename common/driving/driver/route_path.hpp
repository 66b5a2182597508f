// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/driving/driver/route.hpp"
#include "common/driving/driver/way.hpp"

namespace rodeira::driver {

// The middle of a chain of lanes of a network, which must outlive it. Points are exact, distances along it are
// integrated over nodes of half a metre.
class RoutePath final : public Way {
 public:
  RoutePath(const network::Network& network, std::vector<RouteLeg> legs);  // at least one leg

  const std::vector<RouteLeg>& legs() const { return legs_; }
  // The distance at which a leg passes s of its road.
  double Distance(std::size_t leg, double s_m) const;
  double length_m() const override { return nodes_.back().d_m; }
  double SpeedLimit_mps(double d_m) const override;
  LaneFrame At(double d_m) const override;
  double VerticalCurvature_1pm(double d_m) const override;
  Eigen::Vector3d Position(double d_m, double offset_m) const override;
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const override;

 private:
  struct Node {
    double d_m;
    std::size_t leg;
    double s_m;
    Eigen::Vector3d p_W;
  };
  struct Spot {
    std::size_t leg;
    double s_m;
  };
  struct Motion {
    Eigen::Vector3d p_W;
    Eigen::Vector3d v_W;  // by s, along the road
  };
  // Bounds of consecutive nodes.
  struct Box {
    Eigen::Vector3d low_W, high_W;
  };
  Spot SpotAt(double d_m) const;
  Spot SpotBefore(std::vector<Node>::const_iterator after, double d_m) const;
  // The same, looked for from a node on.
  Spot SpotNear(std::size_t node, double d_m) const;
  Motion MotionAt(const Spot& spot) const;
  Eigen::Vector3d Ahead(double d_m) const;  // not of unit length; p in plan, the rise over it in z
  Eigen::Vector3d AheadOf(const Spot& spot, const Motion& motion) const;
  void MakeBoxes();
  // The first of the nodes that are nearest in plan and, if z is given, on its level.
  std::optional<std::size_t> NearestNode(const Eigen::Vector2d& p_W, std::optional<double> z_m) const;

  const network::Network* network_;
  std::vector<RouteLeg> legs_;
  std::vector<Node> nodes_;  // of each leg from its beginning to its end; where legs meet, of both
  std::vector<Box> blocks_;  // of kBlock nodes each
  std::vector<Box> groups_;  // of kBlock blocks each
};

}  // namespace rodeira::driver

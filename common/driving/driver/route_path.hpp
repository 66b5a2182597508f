// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "common/driving/driver/point_boxes.hpp"
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
  Eigen::Vector3d MiddleAt(double d_m) const override;
  double HeadingAt(double d_m) const override;
  double VerticalCurvature_1pm(double d_m) const override;
  Eigen::Vector3d Position(double d_m, double offset_m) const override;
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const override;
  // `hint` is a node's index.
  std::optional<Place> Near(std::size_t& hint, double x_m, double y_m, std::optional<double> z_m,
                            const Range& range) const override;

 private:
  struct Node {
    double d_m;
    std::size_t leg;
    double s_m;
  };
  struct Spot {
    std::size_t leg;
    double s_m;
  };
  struct Motion {
    Eigen::Vector3d p_W;
    Eigen::Vector3d v_W;  // by s, along the road
  };
  Spot SpotAt(double d_m) const;
  Spot SpotBefore(std::vector<Node>::const_iterator after, double d_m) const;
  // The same, looked for from a node on.
  Spot SpotNear(std::size_t node, double d_m) const;
  Motion MotionAt(const Spot& spot) const;
  Eigen::Vector3d TangentAt(double d_m) const;  // not of unit length; p in plan, the rise over it in z
  Eigen::Vector3d AheadOf(const Spot& spot, const Motion& motion) const;
  // The place of a point with this nearest node.
  std::optional<Place> PlaceNear(std::size_t node, const Eigen::Vector2d& p_W) const;

  const network::Network* network_;
  std::vector<RouteLeg> legs_;
  std::vector<Node> nodes_;          // of each leg from its beginning to its end; where legs meet, of both
  std::optional<PointBoxes> boxes_;  // of the nodes
};

}  // namespace rodeira::driver

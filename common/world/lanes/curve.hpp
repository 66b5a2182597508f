// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "common/world/network/network.hpp"

namespace rodeira::lanes {

// A point of a lane's middle, looking the way its traffic goes.
struct CurvePoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();       // on the surface
  Eigen::Vector2d ahead_W = Eigen::Vector2d::UnitX();  // of unit length
  double curvature_1pm = 0.0;                          // positive to the left
  double grade = 0.0;                                  // rise over plan distance
  double bank = 0.0;                                   // rise over the distance to the left
  double rate = 1.0;  // plan distance over d: 1 but between nodes where the file's line has a kink

  Eigen::Vector2d left_W() const { return {-ahead_W.y(), ahead_W.x()}; }
};

// The line on which a lane's traffic keeps, by its own length in plan, d = 0 where it enters: the middle of the lane;
// where the lane opens beside another one of its direction, or narrows to nothing, so far towards that one that a car
// has room (at no width 1.25 m beside the edge, from 3 m on the middle). Nodes at most a metre apart are exact; At is
// the cubic with the tangents of as few of them as tell the others within 1e-6 (of a straight line the first and the
// last): within 1e-5 m for radii over 8 m.
class Curve {
 public:
  // The curve's state at one d, as the network has it there.
  struct Node {
    double d_m = 0.0;
    double s_m = 0.0;  // of the road
    Eigen::Vector3d p_W;
    Eigen::Vector3d along_W;  // dp/dd: of unit length in plan
    double curvature_1pm = 0.0;
    double bank = 0.0;
    double width_m = 0.0;
  };

  // The lane must be one of the network's. along: its traffic goes with growing s.
  Curve(const network::Network& network, const network::LaneKey& lane, bool along);

  double length_m() const { return length_m_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  // Beyond the ends straight on.
  CurvePoint At(double d_m) const;
  // A straight line from the first node to the last, with all that At needs of it: most of a town's ways are that.
  struct Straight {
    Eigen::Vector3d p_W, along_W;
    double bank = 0.0, bank_1pm = 0.0, length_m = 0.0;

    CurvePoint At(double d_m) const;  // to the bit what the curve says
  };
  const std::optional<Straight>& straight() const { return straight_; }
  // Brings near what At will read of a bend about there, while something else is done.
  void Fetch(double d_m) const {
    constexpr std::size_t kLine_bytes = 64;
    __builtin_prefetch(bends_d_m_.data());
    const double share = std::clamp(d_m / length_m_, 0.0, 1.0);
    const auto guess = static_cast<std::size_t>(share * static_cast<double>(bends_.size() - 1));
    const auto *first = reinterpret_cast<const char*>(&bends_[guess == 0 ? 0 : guess - 1]),
               *end = reinterpret_cast<const char*>(bends_.data() + std::min(guess + 3, bends_.size()));
    for (const char* at = first; at < end; at += kLine_bytes) __builtin_prefetch(at);
  }
  // The lane's width, m; linear between nodes, held at the ends.
  double WidthAt(double d_m) const;
  double StationAt(double d_m) const;  // s of the road, held within the section
  double AtStation(double s_m) const;  // its inverse: d, held at the ends

  // A point's place along and beside the curve.
  struct Foot {
    double d_m = 0.0;
    double offset_m = 0.0;  // to the left
  };
  // The foot of (x, y) on the curve near one of its nodes, at most three nodes away; held at the ends.
  Foot FootNear(const Eigen::Vector2d& p_W, std::size_t node) const;

 private:
  std::size_t Before(double d_m) const;                // the node at or before d, not the last
  bool Tells(std::size_t from, std::size_t to) const;  // the cubic from node to node tells those between
  void FindBends();

  std::vector<Node> nodes_;  // at least two
  std::vector<Node>
      bends_;  // of them those that At needs: few where the line is straight, so that they stay in near memory
  std::vector<double> bends_d_m_;
  double length_m_ = 0.0;  // as the last node says: asked for far more often than that node
  std::optional<Straight> straight_;
};

inline CurvePoint Curve::Straight::At(double d_m) const {
  CurvePoint point;
  point.p_W = p_W + d_m * along_W;
  point.ahead_W = along_W.head<2>();
  point.grade = along_W.z();
  point.bank = bank + std::clamp(d_m, 0.0, length_m) * bank_1pm;
  return point;
}

}  // namespace rodeira::lanes

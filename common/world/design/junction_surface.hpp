// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/world/network/road.hpp"

namespace rodeira::design {

// The end of a road that meets a junction: its cross-section, and how it goes on.
struct ArmSection {
  Eigen::Vector2d left_W, right_W;  // of the outermost lanes' edges, as seen from inside the junction, looking out
  Eigen::Vector2d inward_W;         // unit length, at right angles to the line between them
  std::vector<double> at_m;         // from left_W along that line: where the slope across changes, ascending, from 0 on
  std::vector<double> z_m;          // there, without kerbs
  double grade = 0.0;               // dz a metre inward
  double weight = 1.0;
};

// The section of a road at its end; without kerbs. outer: from verge to verge; otherwise of what is paved.
ArmSection SectionOf(const network::Road& road, network::End end, double weight);
// The edges, as seen from inside looking out: left and right; of the paved lanes, or of all.
std::pair<Eigen::Vector2d, Eigen::Vector2d> EdgesAt(const network::Road& road, network::End end, bool paved);

// Height and slopes dz/dx, dz/dy in W.
struct JunctionHeight {
  double z_m = 0.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
};

// A stretch of the outline that meets no road.
struct FreeEdge {
  Eigen::Vector2d from_W, to_W;
};

// The one surface of a junction. Its height at p is the mean of what the roads' ends would have there, going on
// straight, each weighted by weight / d^2 of its distance d: at a road's end it is that road, and neither height nor
// slope jumps.
class JunctionSurface {
 public:
  // Corners counter-clockwise; free edges are those of the outline between two roads.
  JunctionSurface(std::string id, std::vector<ArmSection> arms, std::vector<Eigen::Vector2d> outline,
                  std::vector<Eigen::Vector2d> paved, std::vector<FreeEdge> free_edges);

  const std::string& id() const { return id_; }
  const std::vector<ArmSection>& arms() const { return arms_; }
  const std::vector<Eigen::Vector2d>& outline_W() const { return outline_; }
  const std::vector<Eigen::Vector2d>& paved_W() const { return paved_; }
  const std::vector<FreeEdge>& free_edges() const { return free_edges_; }
  const Eigen::Vector2d& low_W() const { return low_; }
  const Eigen::Vector2d& high_W() const { return high_; }

  // Whether a point lies within the outline, or within the paved part of it.
  bool Contains(const Eigen::Vector2d& p_W) const;
  bool IsPaved(const Eigen::Vector2d& p_W) const;
  // Also a little beyond the outline.
  JunctionHeight At(const Eigen::Vector2d& p_W) const;

 private:
  std::string id_;
  std::vector<ArmSection> arms_;
  std::vector<Eigen::Vector2d> outline_, paved_;
  std::vector<FreeEdge> free_edges_;
  Eigen::Vector2d low_, high_;
};

}  // namespace rodeira::design

// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/paging/tile_tree.hpp"

#include <algorithm>
#include <array>

namespace rodeira::nodes {
namespace {

constexpr std::size_t kFew = 4;      // parts that are no longer divided
constexpr double kSmallest_m = 1.0;  // square; what stands in one place cannot be divided

osg::ref_ptr<osg::Group> Divide(const std::vector<PlacedNode>& parts, const Eigen::Vector2d& low_W, double side_m) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  if (parts.size() <= kFew || side_m < kSmallest_m) {
    for (const PlacedNode& part : parts) group->addChild(part.node);
    return group;
  }
  const double half_m = 0.5 * side_m;
  std::array<std::vector<PlacedNode>, 4> quarters;
  for (const PlacedNode& part : parts)
    quarters[(part.at_W.x() >= low_W.x() + half_m ? 1U : 0U) + (part.at_W.y() >= low_W.y() + half_m ? 2U : 0U)]
        .push_back(part);
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d corner_W = low_W + Eigen::Vector2d(k % 2 == 1 ? half_m : 0.0, k >= 2 ? half_m : 0.0);
    if (quarters[k].size() == parts.size()) return Divide(parts, corner_W, half_m);
    if (!quarters[k].empty()) group->addChild(Divide(quarters[k], corner_W, half_m));
  }
  return group;
}

}  // namespace

osg::ref_ptr<osg::Group> TileTree(const std::vector<PlacedNode>& parts) {
  if (parts.empty()) return new osg::Group;
  Eigen::Vector2d low_W = parts.front().at_W, high_W = low_W;
  for (const PlacedNode& part : parts) low_W = low_W.cwiseMin(part.at_W), high_W = high_W.cwiseMax(part.at_W);
  return Divide(parts, low_W, (high_W - low_W).maxCoeff());
}

}  // namespace rodeira::nodes

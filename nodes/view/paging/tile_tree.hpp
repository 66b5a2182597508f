// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <Eigen/Core>
#include <vector>

namespace rodeira::nodes {

// A part of what stands still, and about where it is.
struct PlacedNode {
  Eigen::Vector2d at_W = Eigen::Vector2d::Zero();
  osg::ref_ptr<osg::Node> node;
};

// Groups of groups, each of a square that is cut into four, with a few parts at its ends: what is out of sight is
// passed over by the square, so that a picture costs with the logarithm of how large the world is. The same parts in
// the same order give the same tree.
osg::ref_ptr<osg::Group> TileTree(const std::vector<PlacedNode>& parts);

}  // namespace rodeira::nodes

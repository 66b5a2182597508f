// SPDX-License-Identifier: Apache-2.0
// The tree in which tiles stand.
#include "nodes/view/paging/tile_tree.hpp"

#include <set>

#include "tests/nodes/view/database_fixture.hpp"

namespace rodeira::nodes {
namespace {

// Squares of squares: no group has many children, all tiles are below it, and each group's ball holds them.
TEST(TileTree, HasSquaresOfSquares) {
  std::vector<PlacedNode> parts;
  for (int column = 0; column < 60; ++column) {
    for (int row = 0; row < 50; ++row) {
      osg::ref_ptr<osg::PagedLOD> tile = new osg::PagedLOD;
      tile->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
      tile->setCenter(osg::Vec3d(256.0 * column, 256.0 * row, 5.0));
      tile->setRadius(350.0F);
      parts.push_back({{256.0 * column, 256.0 * row}, tile});
    }
  }
  const osg::ref_ptr<osg::Group> tree = TileTree(parts);
  const TilesBelow below(*tree);
  EXPECT_EQ(std::set<osg::PagedLOD*>(below.tiles.begin(), below.tiles.end()).size(), parts.size());
  EXPECT_LE(below.most_children, 4u);
  // What touches a ball of 600 m is found by a fraction of all groups and tiles: those with balls that touch it.
  struct Touch : osg::NodeVisitor {
    osg::BoundingSphere about{osg::Vec3(5'000.0F, 7'000.0F, 0.0F), 600.0F};
    std::size_t looked = 0, tiles = 0;
    Touch() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Node& node) override {
      ++looked;
      if (!node.getBound().intersects(about)) return;
      tiles += dynamic_cast<osg::PagedLOD*>(&node) != nullptr;
      traverse(node);
    }
  } touch;
  tree->accept(touch);
  std::size_t expected = 0;
  for (const PlacedNode& part : parts) expected += (part.at_W - Eigen::Vector2d(5'000.0, 7'000.0)).norm() < 949.9;
  EXPECT_NEAR(static_cast<double>(touch.tiles), static_cast<double>(expected), 2.0);
  EXPECT_GT(touch.tiles, 20u);
  EXPECT_LT(touch.looked, 300u) << "of " << parts.size() << " tiles";
  EXPECT_EQ(TileTree({})->getNumChildren(), 0u);
  const std::vector<PlacedNode> same(9, {{3.0, 4.0}, new osg::Group});
  EXPECT_EQ(TileTree(same)->getNumChildren(), 9u) << "what stands in one place";
}

}  // namespace
}  // namespace rodeira::nodes

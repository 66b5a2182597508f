// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/view/scene/tessellation/tile_plan.hpp"

namespace rodeira::scene {

// A corner of a face on one of its levels: in whole steps of height, so that neighbours agree to the bit.
struct CornerHeight {
  double z_m = 0.0;
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitZ();
  bool inside = false;  // SUELO knows ground there
};

// Heights that differ by less count as one.
inline constexpr double kWelded_m = 0.001;

// What SUELO says at every corner of every face, seen from within the face: where it steps there are two heights at one
// place. On the tile's edge the heights follow from the edge's points alone, which both tiles share.
class TileHeights {
 public:
  // Both outlive it.
  TileHeights(const road::World& world, const TilePlan& plan);

  // From the highest to the lowest, as many as the face has levels.
  std::span<const CornerHeight> At(std::uint32_t point, std::uint32_t face) const;
  // The way from one height to another straight up or down at a point, over all heights that any face has there between
  // them: walls that meet at a point have the same vertices.
  std::vector<double> Way(std::uint32_t point, double from_m, double to_m) const;

 private:
  // A face at a point: from where it is asked there, and what it then has.
  struct Corner {
    std::uint32_t face = 0;
    std::uint32_t next = tessellation::Triangulation::kNone;  // of the same point
    int on_edge = -1;  // which of the point's sides on the tile's edge the face has
    double thickness = -1.0;
    Eigen::Vector2d towards_W = Eigen::Vector2d::Zero();
    std::uint32_t first = 0, count = 0;  // of heights_
  };
  // A point on the tile's edge: the middles of its two sides there, in order.
  struct OnEdge {
    std::vector<Eigen::Vector2d> halves_W;
  };
  // Calls use(corner) for each face at a point.
  template <class Use>
  void ForEachCorner(std::uint32_t point, const Use& use) {
    for (std::uint32_t i = first_[point]; i != tessellation::Triangulation::kNone; i = corners_[i].next)
      use(corners_[i]);
  }
  Corner& CornerOf(std::uint32_t point, std::uint32_t face);
  OnEdge& EdgeOf(std::uint32_t point);
  void FindSides();
  void FindAims();
  void QueryFace(const Eigen::Vector2d& p_W, const Corner& corner, std::size_t most);
  std::size_t MostLevels(std::uint32_t point);  // of the faces there
  void Query(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W, std::size_t count,
             std::vector<CornerHeight>& heights, std::size_t least = 1) const;
  std::span<CornerHeight> HeightsOf(const Corner& corner) {
    return std::span(heights_).subspan(corner.first, corner.count);
  }
  void QueryInside(std::uint32_t point);
  void QueryOnEdge(std::uint32_t point);

  const road::World& world_;
  const TilePlan& plan_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> first_;    // by point: of corners_
  std::vector<std::uint32_t> edge_of_;  // by point: where in edges_, one more; 0: not on the tile's edge
  std::vector<OnEdge> edges_;
  std::vector<CornerHeight> heights_;
};

}  // namespace rodeira::scene

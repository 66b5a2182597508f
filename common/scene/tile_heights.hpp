#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "common/scene/tile_plan.hpp"

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
  TileHeights(const road::World& world, const TilePlan& plan);

  // From the highest to the lowest, as many as the face has levels.
  const std::vector<CornerHeight>& At(std::uint32_t point, std::uint32_t face) const { return corners_.at({point, face}); }
  // The way from one height to another straight up or down at a point, over all heights that any face has there between them:
  // walls that meet at a point have the same vertices.
  std::vector<double> Way(std::uint32_t point, double from_m, double to_m) const;

 private:
  struct Aim {
    double thickness = -1.0;
    Eigen::Vector2d towards_W = Eigen::Vector2d::Zero();
    int on_edge = -1;  // which of the point's sides on the tile's edge the face has
  };
  using Corner = std::pair<std::uint32_t, std::uint32_t>;  // point, face
  void FindAims();
  std::vector<CornerHeight> Ask(const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W, std::size_t count) const;
  void AskInside(std::uint32_t point, std::span<const Corner> here);
  void AskOnEdge(std::uint32_t point, std::span<const Corner> here);

  const road::World& world_;
  const TilePlan& plan_;
  std::map<Corner, Aim> aims_;
  std::map<std::uint32_t, std::vector<Eigen::Vector2d>> sides_W_;  // middles of a point's sides on the tile's edge, in order
  std::map<Corner, std::vector<CornerHeight>> corners_;
};

}  // namespace rodeira::scene

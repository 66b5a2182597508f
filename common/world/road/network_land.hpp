// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/world/network/junction_ground.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/decks.hpp"
#include "common/world/road/land_bounds.hpp"
#include "common/world/road/lazy_squares.hpp"
#include "common/world/road/one_ground.hpp"
#include "common/world/road/square_lists.hpp"

namespace rodeira::road {

// Beside its roads an OpenDRIVE file's ground goes on for this far; farther away there is none.
inline constexpr double kVerge_m = 100.0;
// No edge holds the land farther away.
inline constexpr double kHolds_m = 140.0;

// The land beside the roads of an OpenDRIVE file, which says nothing of it. Every place q of a road's edge, d away from
// p, holds the land there between z(q) - d / 2 and z(q) + d / 2 (ever less tightly from 112 m on, not at all from 140 m
// on). The land lies in the middle between the greatest lower and the least upper bound: beside one road level across
// from it, between roads of different heights a bank of 1 in 2. Where roads stand closer than that the bank is as steep
// there as it must be for the bounds to meet, so that the land begins at the height of every edge, and is continuous
// wherever the edges are. Decks (decks.hpp) hold nothing: the land goes through under them. So many bounds of a panel
// are looked at: of the place across from p, of the two by which the land is held most tightly where the road climbs
// evenly, and of some that stand still.
class NetworkLand {
 public:
  explicit NetworkLand(std::shared_ptr<const network::Network> network);

  // Nothing where no road that stands on the ground is nearer than kVerge_m.
  std::optional<PlaneHeight> At(const Eigen::Vector2d& p_W) const;
  // The same, to the bit, without any list: every edge is looked at. For tests.
  std::optional<PlaneHeight> AtBySearch(const Eigen::Vector2d& p_W) const;

  // By road.
  const std::vector<std::vector<Stretch>>& decks() const { return decks_; }
  // Whether s lies in one of the road's decks.
  bool IsOnDeck(std::uint32_t road, double s_m) const;

 private:
  struct Piece {  // of a panel, standing on the ground; or of a junction's boundary
    std::uint32_t road = 0, panel = 0;
    const network::JunctionGround* ground = nullptr;
    Stretch stretch;
    Eigen::Vector2d from_W, to_W;
    Eigen::Vector2d left_W = Eigen::Vector2d::Zero();  // of the line through both
    EdgesAside edges{};                                // from the way and the line between these
    EdgeHeights heights{};
    SteadyEdges steady;
    double right_reach_m = 0.0, left_reach_m = 0.0;  // of what moves with p: less within a bend than to its middle
    std::uint32_t first_post = 0, posts = 0;

    double DistanceFrom(const Eigen::Vector2d& p_W) const {
      return std::max(0.0, SquareLists::Strip{from_W, to_W, 0.0}.FromWay(p_W) - edges.beside_m);
    }
    // The same in fewer operations, and no greater beside its ends; where the road lies on the other side of its axis
    // it is.
    double AsideFrom(const Eigen::Vector2d& p_W) const {
      const double aside_m = left_W.dot(p_W - from_W);
      return std::max(aside_m - edges.left_m, -aside_m - edges.right_m);
    }
  };
  struct Around {  // of a piece what tells in few operations that it is too far away: all of it lies within a circle,
                   // its edges between two heights
    Eigen::Vector2d middle_W;
    double radius_m = 0.0;
    EdgeHeights heights{};

    bool MayBeWithin(const Eigen::Vector2d& p_W, double distance_m) const {
      const double reach_m = distance_m + radius_m;
      return (p_W - middle_W).squaredNorm() <= reach_m * reach_m;
    }
  };
  // tell(piece) for those of which look_at, asked of kBlock neighbours at once and then of each, says so; ascending.
  static constexpr std::uint32_t kBlock = 8;
  template <class LookAt, class Tell>
  void EachOf(std::span<const std::uint32_t> near, const LookAt& look_at, const Tell& tell) const {
    for (const std::uint32_t block : near) {
      if (!look_at(blocks_[block])) continue;
      const auto end = std::min(static_cast<std::uint32_t>(pieces_.size()), (block + 1) * kBlock);
      for (std::uint32_t piece = block * kBlock; piece < end; ++piece) {
        if (look_at(around_[piece])) tell(piece);
      }
    }
  }
  // What may hold the land somewhere in a small square.
  struct Held {
    struct Near {  // a piece
      std::uint32_t piece;
      float distance_m, low_m, high_m;  // it is no nearer to the square's middle, and lies between these heights …
      float rest_low_m, rest_high_m;    // … and it and all behind it between these
    };
    Eigen::Vector2d middle_W;
    std::vector<Near> pieces;  // by distance
  };
  Held MakeHeld(std::span<const std::uint32_t> blocks, const Eigen::Vector2d& middle_W) const;
  std::optional<std::uint32_t> NearestPiece(const Held& held, const Eigen::Vector2d& p_W, double off_m) const;
  void Query(std::uint32_t piece, const Eigen::Vector2d& p_W, LandBounds& bounds) const;
  PlaneHeight Steep(const LandBounds& tightest, const Eigen::Vector2d& p_W) const;
  void AddPieces(std::uint32_t road);
  void AddPosts(const network::Road& road, const geometry::AxisPanel& panel, Piece& piece);
  void AddBoundary(const network::JunctionGround& ground);
  void FromRoad(const Piece& piece, const Eigen::Vector2d& p_W, LandBounds& bounds) const;
  void FromBoundary(const Piece& piece, const Eigen::Vector2d& p_W, LandBounds& bounds) const;
  static void FromPlace(const EdgePlace& place, const Eigen::Vector2d& station_slope_W, double reach_m,
                        const Eigen::Vector2d& p_W, LandBounds& bounds);
  void FromEnd(const EdgePlace& place, const network::Road& road, const Eigen::Vector2d& p_W, LandBounds& bounds) const;
  static void FromPost(const Eigen::Vector3d& post_W, const Eigen::Vector2d& p_W, LandBounds& bounds);

  std::shared_ptr<const network::Network> network_;
  std::vector<std::vector<Stretch>> decks_;
  std::vector<Piece> pieces_;
  std::vector<Around> around_, blocks_;   // by piece; of kBlock of them
  std::vector<Eigen::Vector3d> posts_W_;  // of pieces' edges, that stand still
  SquareLists near_;                      // of blocks
  LazySquares<Held> held_;
};

}  // namespace rodeira::road

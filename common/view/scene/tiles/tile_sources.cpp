// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tiles/tile_sources.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/bytes.hpp"
#include "common/view/scene/tiles/stretch_digest.hpp"
#include "common/world/network/junction_ground.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/earthworks.hpp"
#include "common/world/road/network_land.hpp"
#include "common/world/road/road_edge.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;

constexpr double kJunctionBeyond_m = 20.0;  // so far a junction's edge may lie from the ways through it
constexpr double kStretch_m = 48.0;         // of a road, about
constexpr double kStretchMargin_m = 2.0;  // a stretch ends where the next one begins: what lies just behind counts too
constexpr double kMargin_m = 5.0;         // around everything: ground is asked a little beside a place, too
constexpr std::size_t kPoints = 64;

// A square, and how far its farthest place lies from a point.
struct Cell {
  Vector2d low_W;
  double side_m;

  double Farthest(const Vector2d& p) const {
    const Vector2d from = (p - low_W).cwiseAbs(), to = (p - low_W - Vector2d::Constant(side_m)).cwiseAbs();
    return from.cwiseMax(to).norm();
  }
  // No point of the box has its farthest place of the square nearer than this.
  double LeastFarthest(const Vector2d& box_low, const Vector2d& box_high) const {
    double least = 0.0;
    for (const Vector2d& corner :
         {Vector2d(0.0, 0.0), Vector2d(side_m, 0.0), Vector2d(0.0, side_m), Vector2d(side_m, side_m)}) {
      const Vector2d p = low_W + corner;
      least = std::max(least, (box_low - p).cwiseMax(p - box_high).cwiseMax(0.0).norm());
    }
    return least;
  }
  double Nearest(const Vector2d& box_low, const Vector2d& box_high) const {
    return (box_low - low_W - Vector2d::Constant(side_m)).cwiseMax(low_W - box_high).cwiseMax(0.0).norm();
  }
};

Cell CellOf(const TileKey& tile, std::size_t number, int cells) {
  const double side_m = kTile_m / cells;
  const auto column = static_cast<double>(number / static_cast<std::size_t>(cells)),
             row = static_cast<double>(number % static_cast<std::size_t>(cells));
  return {tile.south_west_W() + side_m * Vector2d(column, row), side_m};
}

// Junctions' surfaces are cut into the ground as roads with the usual slopes are.
base::Digest DigestOf(const design::JunctionSurface& junction) {
  base::ByteWriter out;
  const auto put = [&out](const auto& p) {
    for (const double number : p) out.Put(number + 0.0);
  };
  const auto put_all = [&](const auto& points) {
    out.Put(static_cast<std::uint64_t>(points.size()));
    for (const auto& p : points) put(p);
  };
  for (const design::ArmSection& arm : junction.arms()) {
    for (const Vector2d& p : {arm.left_W, arm.right_W, arm.inward_W}) put(p);
    out.Put(static_cast<std::uint64_t>(arm.at_m.size()));
    put(arm.at_m), put(arm.z_m);
    out.Put(arm.grade + 0.0), out.Put(arm.weight);
  }
  put_all(junction.outline_W()), put_all(junction.paved_W());
  for (const design::FreeEdge& edge : junction.free_edges()) put(edge.from_W), put(edge.to_W);
  return base::Hash(out.bytes());
}

// Where an OpenDRIVE file's road is a deck follows from the roads below it.
base::Digest DecksDigest(const road::World& world, std::uint32_t road) {
  if (world.land() == nullptr) return 0;
  base::ByteWriter out;
  for (const road::Stretch& deck : world.land()->decks()[road])
    out.Put(deck.from_s_m + 0.0), out.Put(deck.to_s_m + 0.0);
  return base::Hash(out.bytes());
}

}  // namespace

double LandReachOf(const road::World& world, const network::Road& road) {
  const network::RoadSpec& spec = road.spec();
  double reach_m = 0.0;
  if (spec.earthwork) reach_m = std::max(spec.earthwork->reach_m, spec.earthwork->blend_m);
  if (!spec.junction.empty()) reach_m = std::max(reach_m, network::Earthwork().reach_m + kJunctionBeyond_m);
  if (world.land() != nullptr) reach_m = road::kHolds_m;
  if (world.grid() != nullptr)
    reach_m = std::max(reach_m, 1.5 * std::max(world.grid()->spacing_x_m(), world.grid()->spacing_y_m()) -
                                    1.0);  // cells that the road itself cuts, too
  return reach_m;
}

TileSources::TileSources(const road::World& world, std::span<const std::vector<Line3>> lines) : world_(&world) {
  PictureDigests pictures;
  for (std::uint32_t road = 0; road < world.network()->roads().size(); ++road) AddStretches(road, pictures);
  AddJunctions();
  for (const std::vector<Line3>& of_road : lines) {
    for (const Line3& line : of_road) {
      for (std::size_t first = 0; first < line.size(); first += kPoints) {
        Points points;
        points.low_W = points.high_W = line[first].head<2>();
        for (const Eigen::Vector3d& p : std::span(line).subspan(first, std::min(kPoints, line.size() - first))) {
          points.at_W.emplace_back(p.head<2>());
          points.low_W = points.low_W.cwiseMin(p.head<2>()), points.high_W = points.high_W.cwiseMax(p.head<2>());
        }
        points_.push_back(std::move(points));
      }
    }
  }
}

// Panels of the axis are short where it bends; straight ones and arcs are cut. An OpenDRIVE file's road is one part:
// there is no end to where it may be the nearest.
void TileSources::AddStretches(std::uint32_t road_index, PictureDigests& pictures) {
  const network::Road& road = world_->network()->roads()[road_index];
  const geometry::PlanAxis& axis = road.axis();
  const double reach_m = LandReachOf(*world_, road);
  Part part;
  double from_s_m = 0.0, to_s_m = 0.0;
  bool begun = false;
  const auto end = [&] {
    if (!begun) return;
    part.reach_m = reach_m, part.beside = true;
    part.digest =
        base::Combine(StretchDigest(*world_, road_index, from_s_m - kStretchMargin_m, to_s_m + kStretchMargin_m),
                      DecksDigest(*world_, road_index));
    parts_.push_back(part);
    part.reach_m = 0.0, part.beside = false;
    part.digest = LookDigest(*world_, road_index, from_s_m - kStretchMargin_m, to_s_m + kStretchMargin_m, pictures);
    parts_.push_back(part);
    begun = false;
  };
  for (const geometry::AxisPanel& panel : axis.panels()) {
    if (panel.begin_s_m() > road.length_m()) break;
    const double beside_m = road::EdgesBeside(road, panel).beside_m;
    const int pieces = std::max(1, static_cast<int>(std::ceil(2.0 * panel.half_m / kStretch_m)));
    for (int i = 0; i < pieces; ++i) {
      const std::array<double, 2> u_m = {panel.half_m * (2.0 * i / pieces - 1.0),
                                         panel.half_m * (2.0 * (i + 1) / pieces - 1.0)};
      if (!begun) from_s_m = panel.middle_s_m + u_m[0];
      to_s_m = panel.middle_s_m + u_m[1];
      for (const double u : u_m) {
        const Vector2d p_W = axis.At(panel, u).p_W, beside = Vector2d::Constant(beside_m);
        part.low_W = begun ? part.low_W.cwiseMin(p_W - beside).eval() : (p_W - beside).eval();
        part.high_W = begun ? part.high_W.cwiseMax(p_W + beside).eval() : (p_W + beside).eval();
        begun = true;
      }
      if (!world_->open_drive() && to_s_m - from_s_m >= 0.75 * kStretch_m) end();
    }
  }
  end();
}

void TileSources::AddJunctions() {
  for (const auto& junction : world_->junctions())
    parts_.push_back(
        {junction->low_W(), junction->high_W(), network::Earthwork().reach_m, false, scene::DigestOf(*junction)});
  for (const network::Junction& junction : world_->network()->junctions()) {
    if (junction.ground != nullptr)
      parts_.push_back({junction.ground->low_W(), junction.ground->high_W(), 0.0, false, junction.ground->Digest()});
  }
}

base::Digest TileSources::Posts(const TileKey& tile, bool& solid) const {
  const terrain::ElevationGrid* grid = world_->grid();
  solid = world_->plane().has_value();
  if (grid == nullptr) return 0;
  const auto& frame = grid->frame();
  const Vector2d first(frame.west_m, frame.south_m), spacing(grid->spacing_x_m(), grid->spacing_y_m());
  const Vector2d low = (tile.south_west_W() - first).cwiseQuotient(spacing),
                 high = low + Vector2d::Constant(kTile_m).cwiseQuotient(spacing);
  solid = low.minCoeff() >= 0.0 && high.x() <= frame.columns - 1 && high.y() <= frame.rows - 1;
  const auto held = [](double at, int count) { return static_cast<int>(std::clamp(at, 0.0, count - 1.0)); };
  const int from_column = held(std::floor(low.x()) - 1.0, frame.columns),
            to_column = held(std::ceil(high.x()) + 1.0, frame.columns);
  const int from_row = held(std::floor(low.y()) - 1.0, frame.rows),
            to_row = held(std::ceil(high.y()) + 1.0, frame.rows);
  base::Digest digest = 0;
  for (int column = from_column; column <= to_column; ++column) {
    const auto posts = grid->heights_m().subspan(
        static_cast<std::size_t>(column) * static_cast<std::size_t>(frame.rows) + static_cast<std::size_t>(from_row),
        static_cast<std::size_t>(to_row - from_row) + 1);
    solid = solid && std::find(posts.begin(), posts.end(), terrain::ElevationGrid::kVoid) == posts.end();
    digest = base::Combine(digest, base::Hash(std::as_bytes(posts)));
  }
  return digest;
}

// A square's places are looked at for its quarters only where they are near enough to it.
void TileSources::NearestIn(const TileKey& tile, const CellBlock& block, double within_m,
                            std::span<const Points* const> may_be, Nearest& nearest) const {
  const Cell cell{tile.south_west_W() + kTile_m / kCells * Vector2d(block.column, block.row),
                  kTile_m / kCells * block.cells};
  for (const Points* points : may_be) {  // some place of theirs is no farther from any of the square
    if (cell.LeastFarthest(points->low_W, points->high_W) > within_m) continue;
    for (const Vector2d& p : points->at_W) within_m = std::min(within_m, cell.Farthest(p));
  }
  if (block.cells == 1) {
    nearest[static_cast<std::size_t>(block.column * kCells + block.row)] = within_m;
    return;
  }
  std::vector<const Points*> near;
  for (const Points* points : may_be) {
    if (cell.Nearest(points->low_W, points->high_W) <= within_m) near.push_back(points);
  }
  const int half = block.cells / 2;
  for (const int column : {0, half}) {
    for (const int row : {0, half})
      NearestIn(tile, {block.column + column, block.row + row, half}, within_m, near, nearest);
  }
}

TileSources::Nearest TileSources::NearestWithin(const TileKey& tile) const {
  constexpr double kAnywhere_m = 1e9;
  std::vector<const Points*> all;
  for (const Points& points : points_) all.push_back(&points);
  Nearest nearest{};
  NearestIn(tile, {0, 0, kCells}, kAnywhere_m, all, nearest);
  return nearest;
}

base::Digest TileSources::DigestOf(const TileKey& tile) const {
  bool solid = false;
  base::Digest digest = Posts(tile, solid);
  const Nearest nearest = solid ? Nearest{} : NearestWithin(tile);
  const double farthest_m = *std::max_element(nearest.begin(), nearest.end());
  const Cell whole{tile.south_west_W(), kTile_m};
  const auto may_be_nearest = [&](const Part& part) {
    if (whole.Nearest(part.low_W, part.high_W) > farthest_m + kMargin_m) return false;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (CellOf(tile, i, kCells).Nearest(part.low_W, part.high_W) <= nearest[i] + kMargin_m) return true;
    }
    return false;
  };
  for (const Part& part : parts_) {
    const Vector2d reach = Vector2d::Constant(part.reach_m + kMargin_m);
    const bool reaches = whole.Nearest(part.low_W - reach, part.high_W + reach) == 0.0;
    if (reaches || (!solid && part.beside && may_be_nearest(part))) digest = base::Combine(digest, part.digest);
  }
  return digest;
}

}  // namespace rodeira::scene

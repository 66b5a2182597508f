#include "common/scene/ground_digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/scene/ground_tile.hpp"
#include "common/scene/lay_picture.hpp"

namespace rodeira::scene {
namespace {

// How far the farthest point of a tile lies from a point, and how near a box.
double Farthest(const Eigen::Vector2d& low, const Eigen::Vector2d& p) {
  const Eigen::Vector2d from = (p - low).cwiseAbs(), to = (p - low - Eigen::Vector2d::Constant(kTile_m)).cwiseAbs();
  return from.cwiseMax(to).norm();
}
double Nearest(const Eigen::Vector2d& low, const Eigen::Vector2d& box_low, const Eigen::Vector2d& box_high) {
  const Eigen::Vector2d high = low + Eigen::Vector2d::Constant(kTile_m);
  return (box_low - high).cwiseMax(low - box_high).cwiseMax(0.0).norm();
}

// No point of the box has its farthest point of the tile nearer than this.
double LeastFarthest(const Eigen::Vector2d& low, const Eigen::Vector2d& box_low, const Eigen::Vector2d& box_high) {
  double least = 0.0;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(kTile_m, 0.0), Eigen::Vector2d(0.0, kTile_m), Eigen::Vector2d(kTile_m, kTile_m)}) {
    const Eigen::Vector2d p = low + corner;
    least = std::max(least, (box_low - p).cwiseMax(p - box_high).cwiseMax(0.0).norm());
  }
  return least;
}

}  // namespace

base::Digest PaintDigest(const TilePaint& paint) {
  base::Digest digest = 0;
  for (const auto& [key, pieces] : paint) {
    for (const PaintPiece& piece : pieces) {
      digest = base::Combine(digest, base::Hash(std::as_bytes(std::span(piece.p_W[0].data(), 12))));
      digest = base::Combine(digest, static_cast<base::Digest>(piece.colour.red) << 16 | static_cast<base::Digest>(piece.colour.green) << 8 | piece.colour.blue);
    }
  }
  return digest;
}

base::Digest RoadDigest(const network::Road& road, std::span<const Line3> lines, const TilePaint& paint) {
  base::Digest digest = base::Hash(road.id());
  for (const Line3& line : lines) {
    digest = base::Combine(digest, base::Hash(std::as_bytes(std::span(line.front().data(), 3 * line.size()))));
  }
  std::string lanes;
  for (const network::LaneSection& section : road.spec().sections) {
    lanes += fmt::format("section {} {}\n", section.s_m, section.end_s_m);
    for (const auto* side : {&section.left, &section.right}) {
      for (const network::Lane& lane : *side) {
        lanes += fmt::format("{} {} {}\n", lane.id, network::LaneTypeName(lane.type), lane.level);
        for (const network::LaneHeight& height : lane.heights) lanes += fmt::format("h {} {} {}\n", height.s_m, height.inner_m, height.outer_m);
        for (const network::LaneMaterial& material : lane.materials) {
          lanes += fmt::format("m {} {} {} {} {}\n", material.s_m, material.surface, material.friction.value_or(-1.0), std::filesystem::path(material.texture).filename().string(),
                               material.texture_width_m);
        }
      }
    }
  }
  if (const auto& earthwork = road.spec().earthwork) lanes += fmt::format("slopes {} {} {} {}\n", earthwork->blend_m, earthwork->cut, earthwork->fill, earthwork->reach_m);
  for (const network::Structure& structure : road.spec().structures) lanes += fmt::format("{} {} {}\n", structure.bridge ? "bridge" : "tunnel", structure.s_m, structure.length_m);
  for (const network::CrgSurface& crg : road.spec().crg) {
    lanes += fmt::format("crg {} {} {} {} {} {} {} {} {} {}\n", crg.s_start_m, crg.s_end_m, crg.s_offset_m, crg.t_offset_m, crg.z_offset_m, crg.z_scale, crg.h_offset_rad,
                         crg.orientation, crg.mode, crg.purpose);
  }
  for (const network::Unevenness& made : road.spec().unevenness) {
    lanes += fmt::format("made {} {} {} {} {}\n", made.s_start_m, made.s_end_m, made.s_offset_m, made.density_m3, made.seed);
  }
  digest = base::Combine(digest, base::Hash(lanes));
  digest = base::Combine(digest, PaintDigest(paint));
  return digest;
}

base::Digest TerrainDigest(const road::World& world) {
  base::Digest digest = base::Combine(base::Hash(fmt::format("{}", static_cast<int>(world.terrain_surface()))), world.measured_digest());
  if (world.grid() != nullptr) {
    const auto& frame = world.grid()->frame();
    digest = base::Combine(digest, base::Hash(fmt::format("{} {} {} {} {} {}", frame.columns, frame.rows, frame.west_m, frame.south_m, frame.east_m, frame.north_m)));
    digest = base::Combine(digest, base::Hash(std::as_bytes(world.grid()->heights_m())));
  }
  if (world.plane()) digest = base::Combine(digest, base::Hash(fmt::format("{} {} {}", world.plane()->z_m, world.plane()->slope_x, world.plane()->slope_y)));
  return base::Combine(digest, PicturesDigest(world));
}

base::Digest GroundPlan::SourceDigest(const TileKey& tile) const {
  const Eigen::Vector2d low = tile.south_west_W();
  double reach = 1e9;  // no point of the tile is farther from its nearest road, or from one whose slopes reach it
  for (const RoadTrace& trace : traces_) {
    if (Nearest(low, trace.low_W, trace.high_W) > reach) continue;
    for (const TracePiece& piece : trace.pieces) {
      if (LeastFarthest(low, piece.low_W, piece.high_W) > reach) continue;
      for (const Eigen::Vector2d& p : std::span(trace.points_W).subspan(piece.first, piece.count)) reach = std::min(reach, Farthest(low, p));
    }
  }
  reach = std::max(reach, slopes_reach_m_);
  base::Digest digest = base::Combine(base::Hash(fmt::format("{} {} {}", kGroundVersion, tile.column, tile.row)), terrain_digest_);
  for (const RoadTrace& trace : traces_) {
    if (Nearest(low, trace.low_W, trace.high_W) <= reach) digest = base::Combine(digest, trace.digest);
  }
  return base::Combine(digest, things_.DigestOf(tile));
}

}  // namespace rodeira::scene

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/geometry/plan_axis.hpp"
#include "common/geometry/plane.hpp"
#include "common/network/band_index.hpp"
#include "common/network/road.hpp"

namespace rodeira::network {

// Between two stations of a road one cubic each is in force for the middle of the lanes, the height and every lane's edge: copies of them.
struct BandPiece {
  double from_s_m = 0.0, to_s_m = -1.0;  // for these s, without the last
  std::uint32_t section = 0;
  std::uint32_t first_lane = 0;          // of BandRecords: those on the left outward, then those on the right
  std::uint16_t left = 0, right = 0;
  bool flat = false;                     // the elevation is all of its height
  geometry::Cubic centre_t, elevation;

  bool Holds(double s_m) const { return s_m >= from_s_m && s_m < to_s_m; }
};

// What is asked of a road where a point lies on one of its bands, side by side in four lines of a cache: copies of the panel, of the lanes'
// edges and of the height. Found through the road itself they are a dozen places far from one another.
struct alignas(64) BandRecord {
  // The band's rectangle, a little wider than it is for what these numbers round off.
  Eigen::Vector2f centre_W, along_W, half_m;  // half_m: along and across
  std::uint32_t road = 0;
  std::uint32_t first_piece = 0;  // of BandRecords: those beside `piece`, ascending
  std::uint16_t pieces = 0;
  bool closed_before = false, closed_behind = false;  // a gap is closed there
  BandPiece piece;                // about the panel's middle; for no s where the road is rolled
  geometry::AxisPanel panel;
  double low_s_m = 0.0, high_s_m = 0.0;  // the panel's part of the road

  // True wherever the band's own Holds is.
  bool MayHold(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2d away = p_W - centre_W.cast<double>(), along = along_W.cast<double>(), half = half_m.cast<double>();
    return std::fabs(away.dot(along)) <= half.x() && std::fabs(geometry::Cross(along, away)) <= half.y();
  }
};
static_assert(sizeof(BandRecord) == 256);

// A lane's outer edge about there.
struct alignas(64) LaneRecord {
  geometry::Cubic edge;  // its width, or where it has a border
  const Lane* lane = nullptr;
  int id = 0;
  bool bordered = false, drivable = false;
};

// The records of all bands. Where a record holds, it gives every bit that the road gives.
class BandRecords {
 public:
  // The roads must stay where they are.
  BandRecords(std::span<const Road> roads, const BandIndex& index);

  const BandRecord& Of(std::uint32_t band) const { return records_[band]; }
  // A record that will be read soon: memory is asked for it meanwhile.
  void Fetch(std::uint32_t band) const {
    const auto* first = reinterpret_cast<const char*>(&records_[band]);
    for (std::size_t at = 0; at < sizeof(BandRecord); at += 64) __builtin_prefetch(first + at);
  }
  void FetchLanes(const BandRecord& record) const {
    const LaneRecord* first = lanes_.data() + record.piece.first_lane;
    __builtin_prefetch(first);
    __builtin_prefetch(first + record.piece.left);
  }
  // The piece in force at s; null where there is none, and the road is to be asked.
  const BandPiece* PieceAt(const BandRecord& record, double s_m) const {
    if (record.piece.Holds(s_m)) return &record.piece;
    for (std::uint32_t i = record.first_piece; i < record.first_piece + record.pieces; ++i) {
      if (pieces_[i].Holds(s_m)) return &pieces_[i];
    }
    return nullptr;
  }
  // As LaneSection::At, and whether the lane is driven on; outside_m too.
  struct LaneAt {
    LaneSpan span;
    int id = 0;  // 0: no lane
    bool drivable = false;
    double outside_m = 0.0;
  };
  LaneAt At(const BandPiece& piece, double s_m, double t_m, const geometry::CubicPoint& centre_t) const;

 private:
  using Known = std::map<std::vector<const void*>, std::uint32_t>;  // where the lanes of a list of edges are
  BandPiece MakePiece(const Road& road, double s_m, Known& known);

  std::vector<BandRecord> records_;
  std::vector<BandPiece> pieces_;
  std::vector<LaneRecord> lanes_;  // bands of one section with the same edges share theirs
};

}  // namespace rodeira::network

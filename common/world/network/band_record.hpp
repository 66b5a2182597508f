// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/geometry/plan_axis.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/network/band_index.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::network {

// A part of a road in which one cubic each describes the lane offset, the elevation and every lane's edge. Cubics that
// are constant there are stored as numbers, here or in BandRecords' numbers; the others in BandRecords' cubics.
struct BandPiece {
  double from_s_m = 0.0, to_s_m = -1.0;  // stations, to_s_m exclusive
  double height_m = 0.0;                 // if `level`
  std::uint32_t section = 0;
  std::uint32_t first = 0;           // index into BandRecords' numbers if `steady`, else into its cubics
  std::uint8_t left = 0, right = 0;  // numbers of lanes
  bool steady = false;               // lane offset and lane edges are constant in the piece
  bool level = false;                // the elevation is constant, too
  bool flat = false;                 // no superelevation, crossfall or lane height: the elevation alone counts

  // The piece ends before to_s_m.
  bool Holds(double s_m) const { return s_m >= from_s_m && s_m < to_s_m; }
};

// The data of a road that a ground query on one of its bands needs, copied into two adjacent cache lines: axis panel,
// lanes and elevation. In the road itself they are spread over a dozen places in memory.
struct alignas(128) BandRecord {
  // The panel's middle and tangent, and about them the rectangle that holds the band, widened by the rounding of
  // these numbers.
  Eigen::Vector2d middle_W, tangent_W;
  double half_m = 0.0, middle_s_m = 0.0;
  float half_along_m = 0.0f, right_m = 0.0f, left_m = 0.0f;  // along the tangent; across, right to left
  std::uint32_t road = 0;
  double curvature_1pm = 0.0;     // of a line or an arc; otherwise AxisPanel::detail
  double high_s_m = 0.0;          // where the panel's part of the road ends
  BandPiece piece;                // at the panel's middle; empty where the road itself must be queried
  std::uint32_t first_piece = 0;  // of BandRecords: those beside `piece`, ascending
  std::uint8_t pieces = 0;
  std::uint8_t kind = 0;                              // AxisPanel::Kind
  bool closed_before = false, closed_behind = false;  // a gap is closed there

  double low_s_m() const { return std::max(middle_s_m - half_m, 0.0); }
  // The panel without its heading, which ground queries do not need.
  geometry::AxisPanel Panel() const {
    const auto its_kind = static_cast<geometry::AxisPanel::Kind>(kind);
    const bool arc = its_kind <= geometry::AxisPanel::Kind::kArc;
    return {its_kind,   arc ? 0 : static_cast<std::uint32_t>(curvature_1pm),
            middle_s_m, half_m,
            0.0,        arc ? curvature_1pm : 0.0,
            middle_W,   tangent_W};
  }
  // Conservative: true wherever the band's own Holds is true.
  bool MayHold(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2d away = p_W - middle_W;
    const double across = geometry::Cross(tangent_W, away);
    return std::fabs(away.dot(tangent_W)) <= static_cast<double>(half_along_m) &&
           across >= static_cast<double>(right_m) && across <= static_cast<double>(left_m);
  }
};
static_assert(sizeof(BandRecord) == 128);

// A lane's outer edge near the panel's middle.
struct alignas(64) LaneRecord {
  geometry::Cubic edge;  // its width, or where it has a border
  int id = 0;
  bool bordered = false, drivable = false;
};

// The records of all bands. Where a record holds, its results equal the road's, bit by bit.
class BandRecords {
 public:
  // The roads must stay where they are.
  BandRecords(std::span<const Road> roads, const BandIndex& index);

  // Precondition: a number of BandIndex::bands().
  const BandRecord& Of(std::uint32_t band) const { return records_[band]; }
  // A record that will be read soon: memory is asked for it meanwhile.
  void Fetch(std::uint32_t band) const {
    __builtin_prefetch(&records_[band]);
    __builtin_prefetch(reinterpret_cast<const char*>(&records_[band]) + 64);
  }
  // The same for the numbers of the lanes in the record's first piece.
  void FetchLanes(const BandRecord& record) const {
    if (!(record.piece.from_s_m < record.piece.to_s_m)) return;
    const void* first = record.piece.steady ? static_cast<const void*>(numbers_.data() + record.piece.first)
                                            : static_cast<const void*>(cubics_.data() + record.piece.first);
    __builtin_prefetch(first);
    if (!record.piece.level) __builtin_prefetch(static_cast<const char*>(first) + 64);
  }
  // The piece in force at s; null where there is none, and the road is to be asked.
  const BandPiece* PieceAt(const BandRecord& record, double s_m) const {
    if (record.piece.Holds(s_m)) return &record.piece;
    for (std::uint32_t i = record.first_piece; i < record.first_piece + record.pieces; ++i) {
      if (pieces_[i].Holds(s_m)) return &pieces_[i];
    }
    return nullptr;
  }
  // As LaneSection::At, but for the lane itself; whether that is driven on, and outside_m too.
  struct LaneAt {
    LaneSpan span;
    int id = 0;  // 0: no lane
    bool drivable = false;
    double outside_m = 0.0;
  };
  // At (s, t); s lies in the piece. A t beyond all lanes of a side finds the outermost one.
  LaneAt At(const BandPiece& piece, double s_m, double t_m) const;
  // The elevation there.
  double Height(const BandPiece& piece, double s_m) const;

 private:
  // Of a piece that is not steady.
  struct Cubics {
    geometry::Cubic centre_t, elevation;
    std::uint32_t first_lane = 0;  // those on the left outward, then those on the right
  };
  struct Known;
  LaneAt AtSteady(const BandPiece& piece, double t_m) const;
  LaneAt AtCubics(const BandPiece& piece, double s_m, double t_m) const;
  BandPiece MakePiece(const Road& road, double s_m, Known& known);
  std::uint32_t Lanes(std::vector<const void*> by, std::vector<LaneRecord> lanes, Known& known);
  std::uint32_t Numbers(std::vector<double> numbers, Known& known);

  std::vector<BandRecord> records_;
  std::vector<BandPiece> pieces_;
  // Of each steady piece which lanes are driven on, a bit each; where the middle of the lanes lies, the outer edges of
  // those on the left outward, of those on the right; the elevation where it is not level. Pieces with the same numbers
  // share theirs, as those with the same lanes do.
  std::vector<double> numbers_;
  std::vector<Cubics> cubics_;
  std::vector<LaneRecord> lanes_;
};

}  // namespace rodeira::network

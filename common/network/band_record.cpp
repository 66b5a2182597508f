#include "common/network/band_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/network/lane_edge.hpp"

namespace rodeira::network {
namespace {

using geometry::Cubic;
using geometry::CubicPoint;
using geometry::CubicTable;

CubicPoint Evaluate(const Cubic& cubic, double s_m) { return {cubic.Value(s_m), cubic.Slope(s_m), 0.0}; }

// The record of a table in force at s, of none a zero; [from, to) becomes no longer than it is in force.
const Cubic& InForce(const CubicTable& table, double s_m, double& from_s_m, double& to_s_m) {
  static const Cubic kZero;
  if (table.empty()) return kZero;
  const Cubic& record = table.At(s_m);
  const auto index = static_cast<std::size_t>(&record - table.records().data());
  if (index > 0) from_s_m = std::max(from_s_m, record.from);
  if (index + 1 < table.records().size()) to_s_m = std::min(to_s_m, table.records()[index + 1].from);
  return record;
}

void SetRectangle(const Band& band, BandRecord& record) {
  const auto up = [](double value) { return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity()); };
  record.centre_W = band.centre_W.cast<float>(), record.along_W = band.along_W.cast<float>();
  // The centre is moved by up to 2^-24 of its coordinates, the direction turned by about as much.
  const double slack_m = std::ldexp(band.centre_W.cwiseAbs().sum() + 4.0 * (band.half_along_m + band.half_across_m), -23);
  record.half_m = {up(band.half_along_m + slack_m), up(band.half_across_m + slack_m)};
}

constexpr std::uint16_t kMostPieces = 64;  // of one panel: the road itself knows the others

}  // namespace

BandRecords::BandRecords(std::span<const Road> roads, const BandIndex& index) {
  Known known;
  for (const Band& band : index.bands()) {
    const Road& road = roads[band.road];
    BandRecord& record = records_.emplace_back();
    SetRectangle(band, record);
    record.panel = road.axis().panels()[band.panel];
    record.low_s_m = std::max(record.panel.begin_s_m(), 0.0), record.high_s_m = std::min(record.panel.end_s_m(), road.length_m());
    record.closed_before = band.closed_before_m > BandIndex::kSlack_m, record.closed_behind = band.closed_behind_m > BandIndex::kSlack_m;
    record.road = band.road;
    if (road.rolled()) continue;
    record.piece = MakePiece(road, std::clamp(record.panel.middle_s_m, record.low_s_m, record.high_s_m), known);
    record.first_piece = static_cast<std::uint32_t>(pieces_.size());
    for (double s = record.low_s_m; s <= record.high_s_m && record.pieces < kMostPieces; s = pieces_.back().to_s_m) {
      if (record.piece.Holds(s)) s = record.piece.to_s_m;
      if (s > record.high_s_m) break;
      pieces_.push_back(MakePiece(road, s, known));
      ++record.pieces;
    }
  }
}

BandPiece BandRecords::MakePiece(const Road& road, double s_m, Known& known) {
  BandPiece piece;
  piece.section = static_cast<std::uint32_t>(road.SectionIndex(s_m));
  piece.flat = road.flat();
  const RoadSpec& spec = road.spec();
  const double infinity = std::numeric_limits<double>::infinity();
  double from = piece.section == 0 ? -infinity : spec.sections[piece.section].s_m;
  double to = piece.section + 1 < spec.sections.size() ? spec.sections[piece.section + 1].s_m : infinity;
  piece.centre_t = InForce(spec.lane_offset, s_m, from, to);
  piece.elevation = InForce(spec.elevation, s_m, from, to);
  const LaneSection& section = spec.sections[piece.section];
  std::vector<LaneRecord> lanes;
  std::vector<const void*> edges = {&section};
  for (const auto* side : {&section.left, &section.right}) {
    for (const Lane& lane : *side) {
      const Cubic& edge = InForce(lane.bordered() ? lane.border : lane.width, s_m, from, to);
      lanes.push_back({edge, &lane, lane.id, lane.bordered(), IsDrivable(lane.type)});
      edges.push_back(&edge);
    }
  }
  piece.left = static_cast<std::uint16_t>(section.left.size()), piece.right = static_cast<std::uint16_t>(section.right.size());
  piece.from_s_m = from, piece.to_s_m = to;
  const auto [found, fresh] = known.try_emplace(std::move(edges), static_cast<std::uint32_t>(lanes_.size()));
  if (fresh) lanes_.insert(lanes_.end(), lanes.begin(), lanes.end());
  piece.first_lane = found->second;
  return piece;
}

BandRecords::LaneAt BandRecords::At(const BandPiece& piece, double s_m, double t_m, const CubicPoint& centre_t) const {
  const bool to_left = t_m >= centre_t.value;
  const double sign = to_left ? 1.0 : -1.0;
  const std::span<const LaneRecord> side = std::span(lanes_).subspan(piece.first_lane + (to_left ? 0u : piece.left), to_left ? piece.left : piece.right);
  CubicPoint inner = centre_t;
  LaneAt at;
  for (const LaneRecord& lane : side) {
    const CubicPoint outer = OuterEdgeBy(lane.bordered, Evaluate(lane.edge, s_m), sign, inner);
    at.span = {lane.lane, inner.value, outer.value, inner.slope, outer.slope};
    at.id = lane.id, at.drivable = lane.drivable;
    if (sign * (outer.value - t_m) >= 0.0 && outer.value != inner.value) return at;
    inner = outer;
  }
  at.outside_m = std::max(0.0, sign * (t_m - inner.value));
  if (at.outside_m == 0.0 && side.empty() && to_left && piece.right > 0) return At(piece, s_m, std::nextafter(t_m, t_m - 1.0), centre_t);
  return at;
}

}  // namespace rodeira::network

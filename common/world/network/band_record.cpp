// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/band_record.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "common/core/geometry/plane.hpp"
#include "common/world/network/lane_edge.hpp"

namespace rodeira::network {
namespace {

using geometry::Cubic;
using geometry::CubicPoint;
using geometry::CubicTable;

CubicPoint Evaluate(const Cubic& cubic, double s_m) { return {cubic.Value(s_m), cubic.Slope(s_m), 0.0}; }

// The record of a table in force at s, of none a zero; [from, to) becomes no longer than it is in force.
const Cubic& RecordInForce(const CubicTable& table, double s_m, double& from_s_m, double& to_s_m) {
  static const Cubic kZero;
  if (table.empty()) return kZero;
  const Cubic& record = table.At(s_m);
  const auto index = static_cast<std::size_t>(&record - table.records().data());
  if (index > 0) from_s_m = std::max(from_s_m, record.from);
  if (index + 1 < table.records().size()) to_s_m = std::min(to_s_m, table.records()[index + 1].from);
  return record;
}

// About the panel's middle what holds the band's rectangle, in single numbers that are no smaller.
void SetRectangle(const Band& band, BandRecord& record) {
  const Eigen::Vector2d along = band.half_along_m * band.along_W,
                        across = band.half_across_m * geometry::Left(band.along_W);
  double half_along_m = 0.0, right_m = std::numeric_limits<double>::infinity(), left_m = -right_m;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(along + across), Eigen::Vector2d(along - across),
                                        Eigen::Vector2d(-along + across), Eigen::Vector2d(-along - across)}) {
    const Eigen::Vector2d away = band.centre_W + corner - record.middle_W;
    const double aside_m = geometry::Cross(record.tangent_W, away);
    half_along_m = std::max(half_along_m, std::fabs(away.dot(record.tangent_W)));
    right_m = std::min(right_m, aside_m), left_m = std::max(left_m, aside_m);
  }
  // Both are found with a rounding of 2^-52 of the coordinates, and rounded to 2^-24 of themselves.
  const double slack_m =
      std::ldexp(band.centre_W.cwiseAbs().sum(), -48) + std::ldexp(band.half_along_m + band.half_across_m, -20);
  record.half_along_m = static_cast<float>(half_along_m + slack_m);
  record.right_m = static_cast<float>(right_m - slack_m), record.left_m = static_cast<float>(left_m + slack_m);
}

void SetPanel(const geometry::AxisPanel& panel, BandRecord& record) {
  record.kind = static_cast<std::uint8_t>(panel.kind);
  record.middle_W = panel.middle_W, record.tangent_W = panel.tangent_W;
  record.half_m = panel.half_m, record.middle_s_m = panel.middle_s_m;
  record.curvature_1pm =
      panel.kind <= geometry::AxisPanel::Kind::kArc ? panel.curvature_1pm : static_cast<double>(panel.detail);
}

// The same number everywhere, and no slope, to the last bit: without a zero that is negative.
bool Constant(const Cubic& cubic) {
  const auto plain_zero = [](double value) { return value == 0.0 && !std::signbit(value); };
  return plain_zero(cubic.b) && plain_zero(cubic.c) && plain_zero(cubic.d) &&
         !(cubic.a == 0.0 && std::signbit(cubic.a));
}

constexpr std::uint8_t kMaxPieces = 64;   // of one panel; of others the road itself is queried
constexpr std::size_t kMaxLanes = 64;     // of a steady piece
constexpr std::size_t kMaxOfASide = 255;  // of any

}  // namespace

// Where what was made already is.
struct BandRecords::Known {
  std::map<std::vector<const void*>, std::uint32_t> lanes;      // by section and cubics
  std::map<std::vector<std::uint64_t>, std::uint32_t> numbers;  // by their bits
};

BandRecords::BandRecords(std::span<const Road> roads, const BandIndex& index) {
  Known known;
  records_.reserve(index.bands().size());
  for (const Band& band : index.bands()) {
    const Road& road = roads[band.road];
    BandRecord& record = records_.emplace_back();
    SetPanel(road.axis().panels()[band.panel], record);
    SetRectangle(band, record);
    record.high_s_m = std::min(road.axis().panels()[band.panel].end_s_m(), road.length_m());
    record.closed_before = band.closed_before_m > BandIndex::kSlack_m,
    record.closed_behind = band.closed_behind_m > BandIndex::kSlack_m;
    record.road = band.road;
    const double low = record.low_s_m(), high = record.high_s_m;
    if (road.LeansBetween(low, high)) continue;
    record.piece = MakePiece(road, std::clamp(record.middle_s_m, low, high), known);
    record.first_piece = static_cast<std::uint32_t>(pieces_.size());
    for (double s = low; s <= high && record.pieces < kMaxPieces; s = pieces_.back().to_s_m) {
      if (record.piece.Holds(s)) s = record.piece.to_s_m;
      if (s > high) break;
      const BandPiece piece = MakePiece(road, s, known);
      if (!piece.Holds(s)) break;
      pieces_.push_back(piece);
      ++record.pieces;
    }
  }
}

BandPiece BandRecords::MakePiece(const Road& road, double s_m, Known& known) {
  BandPiece piece;
  piece.section = static_cast<std::uint32_t>(road.SectionIndex(s_m));
  piece.flat = road.flat();
  const RoadSpec& spec = road.spec();
  const LaneSection& section = spec.sections[piece.section];
  if (section.left.size() > kMaxOfASide || section.right.size() > kMaxOfASide) return {};
  const double infinity = std::numeric_limits<double>::infinity();
  double from = piece.section == 0 ? -infinity : section.s_m;
  double to = piece.section + 1 < spec.sections.size() ? spec.sections[piece.section + 1].s_m : infinity;
  const Cubic& centre = RecordInForce(spec.lane_offset, s_m, from, to);
  const Cubic& elevation = RecordInForce(spec.elevation, s_m, from, to);
  std::vector<LaneRecord> lanes;
  std::vector<const void*> by = {&section};
  std::vector<double> edges = {centre.a};
  std::uint64_t driven = 0;
  piece.steady = Constant(centre) && section.left.size() + section.right.size() <= kMaxLanes;
  for (const auto* side : {&section.left, &section.right}) {
    CubicPoint inner = Evaluate(centre, s_m);
    for (const Lane& lane : *side) {
      const bool bordered = lane.bordered();
      const Cubic& edge = RecordInForce(bordered ? lane.border : lane.width, s_m, from, to);
      const auto number =
          static_cast<int>(side == &section.left ? lanes.size() + 1 : lanes.size() - section.left.size() + 1);
      piece.steady = piece.steady && Constant(edge) && lane.id == (side == &section.left ? number : -number);
      inner = OuterEdgeBy(bordered, Evaluate(edge, s_m), side == &section.left ? 1.0 : -1.0, inner);
      if (piece.steady) driven |= std::uint64_t{IsDrivable(lane.type)} << lanes.size();
      edges.push_back(inner.value);
      lanes.push_back({edge, lane.id, bordered, IsDrivable(lane.type)});
      by.push_back(&edge);
    }
  }
  piece.left = static_cast<std::uint8_t>(section.left.size()),
  piece.right = static_cast<std::uint8_t>(section.right.size());
  piece.from_s_m = from, piece.to_s_m = to;
  piece.level = Constant(elevation);
  if (piece.level) piece.height_m = elevation.a;
  if (piece.steady) {
    edges.insert(edges.begin(), std::bit_cast<double>(driven));
    if (!piece.level) edges.insert(edges.end(), {elevation.from, elevation.a, elevation.b, elevation.c, elevation.d});
    piece.first = Numbers(std::move(edges), known);
    return piece;
  }
  piece.first = static_cast<std::uint32_t>(cubics_.size());
  cubics_.push_back({centre, elevation, Lanes(std::move(by), std::move(lanes), known)});
  return piece;
}

std::uint32_t BandRecords::Lanes(std::vector<const void*> by, std::vector<LaneRecord> lanes, Known& known) {
  const auto [found, fresh] = known.lanes.try_emplace(std::move(by), static_cast<std::uint32_t>(lanes_.size()));
  if (fresh) lanes_.insert(lanes_.end(), lanes.begin(), lanes.end());
  return found->second;
}

std::uint32_t BandRecords::Numbers(std::vector<double> numbers, Known& known) {
  std::vector<std::uint64_t> bits;
  for (const double number : numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
  const auto [found, fresh] = known.numbers.try_emplace(std::move(bits), static_cast<std::uint32_t>(numbers_.size()));
  if (fresh) numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
  return found->second;
}

double BandRecords::Height(const BandPiece& piece, double s_m) const {
  if (piece.level) return piece.height_m;
  if (!piece.steady) return cubics_[piece.first].elevation.Value(s_m);
  const double* numbers = &numbers_[piece.first + 2u + piece.left + piece.right];
  return Cubic{numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]}.Value(s_m);
}

BandRecords::LaneAt BandRecords::At(const BandPiece& piece, double s_m, double t_m) const {
  return piece.steady ? AtSteady(piece, t_m) : AtCubics(piece, s_m, t_m);
}

BandRecords::LaneAt BandRecords::AtSteady(const BandPiece& piece, double t_m) const {
  const double* numbers = &numbers_[piece.first];
  const double centre = numbers[1];
  const bool to_left = t_m >= centre;
  const double sign = to_left ? 1.0 : -1.0;
  const int count = to_left ? piece.left : piece.right, before = to_left ? 0 : piece.left;
  double inner = centre;
  LaneAt at;
  for (int i = 0; i < count; ++i) {
    const double outer = numbers[2 + before + i];
    at.span = {nullptr, inner, outer, 0.0, 0.0};
    at.id = to_left ? i + 1 : -i - 1;
    at.drivable = (std::bit_cast<std::uint64_t>(numbers[0]) >> (before + i) & 1) != 0;
    if (sign * (outer - t_m) >= 0.0 && outer != inner) return at;
    inner = outer;
  }
  at.outside_m = std::max(0.0, sign * (t_m - inner));
  if (at.outside_m == 0.0 && count == 0 && to_left && piece.right > 0)
    return AtSteady(piece, std::nextafter(t_m, t_m - 1.0));
  return at;
}

BandRecords::LaneAt BandRecords::AtCubics(const BandPiece& piece, double s_m, double t_m) const {
  const Cubics& cubics = cubics_[piece.first];
  const CubicPoint centre = Evaluate(cubics.centre_t, s_m);
  const bool to_left = t_m >= centre.value;
  const double sign = to_left ? 1.0 : -1.0;
  const std::span<const LaneRecord> side =
      std::span(lanes_).subspan(cubics.first_lane + (to_left ? 0u : piece.left), to_left ? piece.left : piece.right);
  CubicPoint inner = centre;
  LaneAt at;
  for (const LaneRecord& lane : side) {
    const CubicPoint outer = OuterEdgeBy(lane.bordered, Evaluate(lane.edge, s_m), sign, inner);
    at.span = {nullptr, inner.value, outer.value, inner.slope, outer.slope};
    at.id = lane.id, at.drivable = lane.drivable;
    if (sign * (outer.value - t_m) >= 0.0 && outer.value != inner.value) return at;
    inner = outer;
  }
  at.outside_m = std::max(0.0, sign * (t_m - inner.value));
  if (at.outside_m == 0.0 && side.empty() && to_left && piece.right > 0)
    return AtCubics(piece, s_m, std::nextafter(t_m, t_m - 1.0));
  return at;
}

}  // namespace rodeira::network

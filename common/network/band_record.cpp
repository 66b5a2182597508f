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

}  // namespace

BandRecords::BandRecords(std::span<const Road> roads, const BandIndex& index) {
  std::map<std::vector<const void*>, std::uint32_t> known;  // where the lanes of a list of edges are
  for (const Band& band : index.bands()) {
    const Road& road = roads[band.road];
    BandRecord& record = records_.emplace_back();
    record.panel = road.axis().panels()[band.panel];
    record.low_s_m = std::max(record.panel.begin_s_m(), 0.0), record.high_s_m = std::min(record.panel.end_s_m(), road.length_m());
    record.closed_before_m = band.closed_before_m, record.closed_behind_m = band.closed_behind_m;
    record.road = band.road;
    if (road.rolled()) continue;
    const double middle = std::clamp(record.panel.middle_s_m, record.low_s_m, record.high_s_m);
    record.section = static_cast<std::uint32_t>(road.SectionIndex(middle));
    record.flat = road.flat();
    const RoadSpec& spec = road.spec();
    const double infinity = std::numeric_limits<double>::infinity();
    double from = record.section == 0 ? -infinity : spec.sections[record.section].s_m;
    double to = record.section + 1 < spec.sections.size() ? spec.sections[record.section + 1].s_m : infinity;
    record.centre_t = InForce(spec.lane_offset, middle, from, to);
    record.elevation = InForce(spec.elevation, middle, from, to);
    const LaneSection& section = spec.sections[record.section];
    std::vector<LaneRecord> lanes;
    std::vector<const void*> edges = {&section};
    for (const auto* side : {&section.left, &section.right}) {
      for (const Lane& lane : *side) {
        const bool bordered = lane.width.empty() && !lane.border.empty();
        const Cubic& edge = InForce(bordered ? lane.border : lane.width, middle, from, to);
        lanes.push_back({edge, &lane, lane.id, bordered, IsDrivable(lane.type)});
        edges.push_back(&edge);
      }
    }
    record.left = static_cast<std::uint16_t>(section.left.size()), record.right = static_cast<std::uint16_t>(section.right.size());
    record.from_s_m = from, record.to_s_m = to;
    const auto [found, fresh] = known.try_emplace(std::move(edges), static_cast<std::uint32_t>(lanes_.size()));
    if (fresh) lanes_.insert(lanes_.end(), lanes.begin(), lanes.end());
    record.first_lane = found->second;
  }
}

BandRecords::LaneAt BandRecords::At(const BandRecord& record, double s_m, double t_m, const CubicPoint& centre_t) const {
  const bool to_left = t_m >= centre_t.value;
  const double sign = to_left ? 1.0 : -1.0;
  const std::span<const LaneRecord> side = std::span(lanes_).subspan(record.first_lane + (to_left ? 0u : record.left), to_left ? record.left : record.right);
  CubicPoint inner = centre_t;
  LaneAt at;
  for (const LaneRecord& lane : side) {
    const CubicPoint outer = OuterEdgeBy(lane.bordered, Evaluate(lane.edge, s_m), sign, inner, centre_t);
    at.span = {lane.lane, inner.value, outer.value, inner.slope, outer.slope};
    at.id = lane.id, at.drivable = lane.drivable;
    if (sign * (outer.value - t_m) >= 0.0 && outer.value != inner.value) return at;
    inner = outer;
  }
  at.outside_m = std::max(0.0, sign * (t_m - inner.value));
  if (at.outside_m == 0.0 && side.empty() && to_left && record.right > 0) return At(record, s_m, std::nextafter(t_m, t_m - 1.0), centre_t);
  return at;
}

}  // namespace rodeira::network

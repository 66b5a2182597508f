// SPDX-License-Identifier: Apache-2.0
// Where a lane's border lies within the edge of the lane inside of it: the lane would have a width below 0.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/cubic_extremes.hpp"

namespace rodeira::opendrive {
namespace {

using geometry::Cubic;
using geometry::CubicTable;
using network::Lane;

constexpr double kAsamOverlap_m = 1e-6;  // the limit of ASAM's checker

// The record in force from s on, as a cubic that begins there; a table without any is 0.
Cubic From(const CubicTable& table, double s_m) {
  if (table.empty()) return {s_m, 0.0, 0.0, 0.0, 0.0};
  const Cubic& record = table.At(s_m);
  return {s_m, record.Value(s_m), record.Slope(s_m), 0.5 * record.Bend(s_m), record.d};
}

// a + sign b, of cubics that begin at the same place.
Cubic Sum(const Cubic& a, double sign, const Cubic& b) {
  return {a.from, a.a + sign * b.a, a.b + sign * b.b, a.c + sign * b.c, a.d + sign * b.d};
}

// Where between two stations a record of the lanes' edges begins.
std::set<double> Begins(const CubicTable& centre, const std::vector<Lane>& lanes, double from_m, double to_m) {
  std::set<double> begins = {from_m};
  const auto add = [&](const CubicTable& table) {
    for (const Cubic& record : table.records()) {
      if (record.from > from_m && record.from < to_m) begins.insert(record.from);
    }
  };
  add(centre);
  for (const Lane& lane : lanes) add(lane.bordered() ? lane.border : lane.width);
  return begins;
}

}  // namespace

void CheckBorders(const RoadReading& road, const Tolerance& tolerance, Findings& findings) {
  const auto& sections = road.spec.sections;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double end_m = i + 1 < sections.size() ? sections[i + 1].s_m : road.spec.length_m;
    for (const auto* side : {&sections[i].left, &sections[i].right}) {
      if (std::none_of(side->begin(), side->end(), [](const Lane& lane) { return lane.bordered(); })) continue;
      const double sign = side == &sections[i].left ? 1.0 : -1.0;
      const std::set<double> begins = Begins(road.spec.lane_offset, *side, sections[i].s_m, end_m);
      std::vector<Extreme> worst(side->size());
      for (auto begin = begins.begin(); begin != begins.end(); ++begin) {
        const double to_m = std::next(begin) == begins.end() ? std::max(end_m, *begin) : *std::next(begin);
        Cubic inner = From(road.spec.lane_offset, *begin);
        for (std::size_t k = 0; k < side->size(); ++k) {
          const Lane& lane = (*side)[k];
          const Cubic outer = lane.bordered() ? From(lane.border, *begin) : Sum(inner, sign, From(lane.width, *begin));
          const Cubic width = sign > 0.0 ? Sum(outer, -1.0, inner) : Sum(inner, -1.0, outer);
          const Extreme least = LeastOf(width, *begin, to_m);
          if (lane.bordered() && least.value < worst[k].value) worst[k] = least;
          inner = outer;
        }
      }
      for (std::size_t k = 0; k < side->size(); ++k) {
        const double within_m = -worst[k].value, most_m = tolerance.strict ? kAsamOverlap_m : tolerance.gap_m;
        if (!(within_m > kAsamOverlap_m)) continue;
        const Finding finding{
            "road.lane.border.overlap_with_inner_lanes",
            fmt::format("the lane's border lies {:.4g} m within the edge of the lane inside of it; {}", within_m,
                        within_m > most_m ? fmt::format("at most {:.3g} m was expected", most_m)
                                          : "the lane is read as 0 m wide there"),
            road.lines.sections[i],
            road.spec.id,
            (*side)[k].id,
            worst[k].at,
            within_m > most_m ? Repair{RepairKind::kWidthZero, "the lane is read as 0 m wide there"} : Repair{}};
        (within_m > most_m ? findings.errors : findings.warnings).push_back(finding);
      }
    }
  }
}

}  // namespace rodeira::opendrive

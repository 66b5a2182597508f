// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/beside.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/config/either.hpp"
#include "common/world/design/section_reader.hpp"
#include "common/world/design/tables.hpp"

namespace rodeira::design {
namespace {

using IndexRange = std::pair<std::size_t, std::size_t>;

}  // namespace

Beside::Beside(const config::DeclaredMap& item, const network::RoadSpec& spec, double usual_m, bool right_side) {
  if (item.map().Has("t_m")) {
    (void)config::RejectConflictingKeys(item.map(), "t_m", "side"),
        (void)config::RejectConflictingKeys(item.map(), "t_m", "beside_m");
    along_ = Constant(item.RequiredNumber("t_m"));
    return;
  }
  const bool right = item.Word("side", right_side ? "right" : "left") == "right";
  const double beside = item.Number("beside_m", usual_m);
  const auto& section = spec.sections[0];
  along_ = EdgeOf(spec, right ? -static_cast<int>(section.right.size()) : static_cast<int>(section.left.size()));
  beside_m_ = right ? -beside : beside;
}

std::vector<double> Beside::Knots() const {
  std::vector<double> knots;
  for (const geometry::Cubic& record : along_.records()) knots.push_back(record.from);
  return knots;
}

std::vector<IndexRange> StraightPieces(const std::vector<double>& s_m, const std::vector<double>& t_m, double within_m,
                                       bool chain) {
  std::vector<IndexRange> pieces, open{{0, s_m.size() - 1}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double most = within_m;
    std::size_t worst = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double share = (s_m[i] - s_m[from]) / (s_m[to] - s_m[from]);
      const double off = std::fabs(t_m[from] + share * (t_m[to] - t_m[from]) - t_m[i]);
      if (off > most) most = off, worst = i;
    }
    if (worst == from) {
      pieces.emplace_back(from, to);
      continue;
    }
    open.emplace_back(chain ? worst : worst + 1, to);
    open.emplace_back(from, worst);
  }
  return pieces;
}

const network::Lane* DrivenLaneAt(const network::RoadSpec& spec, double s_m, double t_m, double reach_m) {
  const network::LaneSection& section = spec.sections[0];
  for (const auto* side : {&section.left, &section.right}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type)) continue;
      const network::LaneSpan span = *section.Span(lane.id, spec.lane_offset.Evaluate(s_m), s_m);
      const auto [low, high] = std::minmax(span.inner_t_m, span.outer_t_m);
      if (high - low > 1e-6 && t_m + reach_m > low && t_m - reach_m < high) return &lane;
    }
  }
  return nullptr;
}

}  // namespace rodeira::design

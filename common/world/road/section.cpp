// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/section.hpp"

#include <algorithm>
#include <cstdlib>

#include "common/core/base/assert.hpp"

namespace rodeira::road {
namespace {

// From the axis outward on one side: sign +1 to the left, -1 to the right. The bands come out in that order.
std::vector<Band> SideBands(const SectionSpec& spec, double sign, double lanes_edge_m) {
  const Shoulder& shoulder = sign > 0.0 ? spec.left : spec.right;
  const double lane_fall = sign > 0.0 ? spec.fall_left : spec.fall_right;
  std::vector<Band> bands;
  double width = 0.0;  // from the axis
  double z = 0.0;
  const auto add = [&](double strip_m, double fall, ground::Surface surface) {
    if (strip_m <= 0.0) return;
    const double next = z - fall * strip_m;
    const double slope = -fall * sign;  // dz/dt
    if (sign > 0.0)
      bands.push_back({width, width + strip_m, z, slope, surface});
    else
      bands.push_back({-(width + strip_m), -width, next, slope, surface});
    width += strip_m;
    z = next;
  };
  add(std::abs(lanes_edge_m), lane_fall, spec.surface);
  add(shoulder.width_m, shoulder.fall, shoulder.surface);
  add(spec.verge.width_m, spec.verge.fall, spec.verge.surface);
  return bands;
}

}  // namespace

Section::Section(SectionSpec spec) : spec_(std::move(spec)) {
  RODEIRA_ASSERT(!spec_.lanes.empty() && spec_.blend_m > 0.0);
  std::sort(spec_.lanes.begin(), spec_.lanes.end(), [](const Lane& a, const Lane& b) { return a.id < b.id; });
  const auto place = [](Lane& lane, double& edge, double sign) {
    RODEIRA_ASSERT(lane.width_m > 0.0);
    lane.inner_t_m = edge;
    edge += sign * lane.width_m;
    lane.outer_t_m = edge;
  };
  int expected = -1;
  for (auto lane = spec_.lanes.rbegin(); lane != spec_.lanes.rend(); ++lane) {
    if (lane->id > 0) continue;
    RODEIRA_ASSERT(lane->id == expected--);
    place(*lane, lanes_right_m_, -1.0);
  }
  expected = 1;
  for (Lane& lane : spec_.lanes) {
    if (lane.id < 0) continue;
    RODEIRA_ASSERT(lane.id == expected++);
    place(lane, lanes_left_m_, 1.0);
  }
  bands_ = SideBands(spec_, -1.0, lanes_right_m_);
  std::reverse(bands_.begin(), bands_.end());
  const auto left = SideBands(spec_, 1.0, lanes_left_m_);
  bands_.insert(bands_.end(), left.begin(), left.end());
}

const Lane* Section::FindLane(int id) const {
  for (const Lane& lane : spec_.lanes) {
    if (lane.id == id) return &lane;
  }
  return nullptr;
}

double Section::reach_m() const { return std::max(blend_left_m(), -blend_right_m()); }

const Band& Section::BandAt(double t_m) const {
  std::size_t i = 0;
  while (i + 1 < bands_.size() && t_m >= bands_[i].to_t_m) ++i;
  return bands_[i];
}

}  // namespace rodeira::road

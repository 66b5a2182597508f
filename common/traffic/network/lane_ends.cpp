// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/lane_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/traffic/demand/spawn.hpp"
#include "common/traffic/lane_change/lane_change.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRoom_m = 30.0;         // of a lane change from rest
constexpr double kSamplingStep_m = 5.0;  // between two places that are checked
constexpr double kNothing_m = 0.5;       // wide, no lane is left
constexpr double kNowhere_m = std::numeric_limits<double>::infinity();

bool IsWide(const lanes::Curve& curve, double from_m, double to_m) {
  for (double d = from_m; d < to_m + kSamplingStep_m; d += kSamplingStep_m) {
    const double at = std::min(d, to_m);
    if (curve.WidthAt(at) < kMinLaneChangeWidth_m || std::fabs(curve.At(at).curvature_1pm) > kTightestLaneChange_1pm)
      return false;
  }
  return true;
}

// The end of the last part of the track that is long enough for a change to a lane beside; below 0 where none is.
double ChangeEnds(const lanes::Graph& graph, const lanes::EdgeMarks& marks, std::uint32_t track) {
  const lanes::Track& on = graph[track];
  if (on.junction >= 0) return -1.0;
  for (double to = on.length_m(); to >= kRoom_m; to -= kSamplingStep_m) {
    if (!IsWide(on.curve, to - kRoom_m, to)) continue;
    for (const auto& [beside, side] : {std::pair{on.left, lanes::Side::kLeft}, {on.right, lanes::Side::kRight}}) {
      if (beside && marks.MayCross(track, side, to - kRoom_m, to)) return to;
    }
  }
  return -1.0;
}

// The last place of the track with room for a vehicle before the lane narrows to nothing, at its end or, as bays beside
// a street do, within it; 0 where it has room nowhere, infinite where its end has.
double NarrowsFrom(const lanes::Track& track) {
  double room_m = 0.0;
  for (const lanes::Curve::Node& node : track.curve.nodes()) {
    if (node.width_m >= kMinSpawnWidth_m) room_m = node.d_m;
    if (node.width_m < kNothing_m && room_m > 0.0) return room_m;
  }
  return track.curve.nodes().back().width_m >= kMinSpawnWidth_m ? kNowhere_m : room_m;
}

// By track, from the ends backward: what leads only onto tracks without room leads nowhere either.
std::vector<double> NarrowEnds(const lanes::Graph& graph, const std::vector<bool>& blunt) {
  std::vector<double> from_m(graph.tracks().size(), kNowhere_m);
  std::vector<std::uint32_t> open;
  for (std::uint32_t track = 0; track < from_m.size(); ++track) {
    if (graph[track].next.empty()) open.push_back(track);
  }
  const auto leads_nowhere = [&](const lanes::Link& link) { return from_m[link.to] <= 0.0; };
  for (std::size_t i = 0; i < open.size(); ++i) {
    const lanes::Track& on = graph[open[i]];
    if (blunt[open[i]] || on.junction >= 0 || !std::ranges::all_of(on.next, leads_nowhere)) continue;
    from_m[open[i]] = NarrowsFrom(on);
    if (from_m[open[i]] <= 0.0) open.insert(open.end(), on.before.begin(), on.before.end());
  }
  return from_m;
}

}  // namespace

LaneEnds::LaneEnds(const lanes::Graph& graph, const lanes::EdgeMarks& marks)
    : blunt_(graph.tracks().size()), change_ends_m_(graph.tracks().size(), -1.0) {
  std::vector<std::uint32_t> open;
  const auto add = [&](std::uint32_t track) {
    if (blunt_[track]) return;
    blunt_[track] = true;
    change_ends_m_[track] = ChangeEnds(graph, marks, track);
    open.push_back(track);
  };
  for (std::uint32_t track = 0; track < blunt_.size(); ++track) {
    const lanes::Track& on = graph[track];
    if (!on.next.empty() || on.junction >= 0) continue;
    const auto goes_on = [&](const auto& beside) { return beside && !graph[*beside].next.empty(); };
    if (goes_on(on.left) || goes_on(on.right))
      add(track);
    else
      change_ends_m_[track] = ChangeEnds(graph, marks, track);
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (change_ends_m_[open[i]] >= 0.0) continue;
    for (const std::uint32_t before : graph[open[i]].before) {
      if (graph[before].next.size() == 1 && graph[before].junction < 0) add(before);
    }
  }
  narrows_from_m_ = NarrowEnds(graph, blunt_);
}

}  // namespace rodeira::traffic

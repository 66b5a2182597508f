// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/opposite.hpp"

#include <algorithm>

#include "common/world/lanes/signs.hpp"

namespace rodeira::lanes {
namespace {

constexpr std::size_t kMaxBack = 64;  // tracks over which a sign is looked for

bool IsOnlyOne(const Track& track) { return track.junction < 0 && !track.left && !track.right; }

}  // namespace

std::vector<std::int64_t> Opposites(const Graph& graph) {
  std::vector<std::int64_t> opposites(graph.tracks().size(), -1);
  for (std::uint32_t i = 0; i < opposites.size(); ++i) {
    const Track& track = graph[i];
    if (!IsOnlyOne(track)) continue;
    const auto other = graph.Oncoming(i);
    if (other && IsOnlyOne(graph[*other])) opposites[i] = *other;
  }
  return opposites;
}

NoOvertaking::NoOvertaking(const Graph& graph)
    : begins_(graph.tracks().size(), false), changes_(graph.tracks().size()) {
  for (std::uint32_t i = 0; i < changes_.size(); ++i) {
    const Track& track = graph[i];
    if (track.junction >= 0) continue;
    const auto& nodes = track.curve.nodes();
    const double low = std::min(nodes.front().s_m, nodes.back().s_m),
                 high = std::max(nodes.front().s_m, nodes.back().s_m);
    for (const network::Signal& signal : graph.network().roads()[track.lane.road].spec().signals) {
      const bool forbids = signal.type == "276", ends = signal.type == "280" || signal.type == "282";
      if ((!forbids && !ends) || signal.s_m < low || signal.s_m > high) continue;
      if (HoldsFor(track.lane.lane, track.along, signal.orientation, signal.validity))
        changes_[i].push_back({track.curve.AtStation(signal.s_m), forbids});
    }
    std::stable_sort(changes_[i].begin(), changes_[i].end(),
                     [](const Change& a, const Change& b) { return a.d_m < b.d_m; });
  }
  for (std::uint32_t i = 0; i < begins_.size(); ++i) {
    std::uint32_t at = i;
    for (std::size_t back = 0; back < kMaxBack; ++back) {
      if (graph[at].junction >= 0 || graph[at].before.size() != 1) break;
      at = graph[at].before.front();
      if (changes_[at].empty()) continue;
      begins_[i] = graph[at].junction < 0 && changes_[at].back().forbids;
      break;
    }
  }
}

bool NoOvertaking::Allows(std::uint32_t track, double from_d_m, double to_d_m) const {
  bool forbids = begins_[track];
  for (const Change& change : changes_[track]) {
    if (change.d_m > to_d_m) break;
    if (change.d_m > from_d_m && (forbids || change.forbids)) return false;
    forbids = change.forbids;
  }
  return !forbids;
}

}  // namespace rodeira::lanes

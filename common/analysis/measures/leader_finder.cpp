// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/leader_finder.hpp"

#include <algorithm>

#include "common/analysis/measures/preferred.hpp"

namespace rodeira::measures {
namespace {

constexpr int kMaxTracks = 200;  // of a way; roads that are cut into very short sections end earlier

}  // namespace

void LeaderFinder::SetOthers(std::span<const OtherVehicle> others) {
  on_track_.clear();
  for (const OtherVehicle& other : others) {
    const auto at = finder_.FindTrack(other.x_m, other.y_m, other.z_m, hints_[other.id]);
    if (at) on_track_[at->track].push_back({&other, at->along_m});
  }
}

NearBoth LeaderFinder::Find(std::uint32_t track, double along_m, double front_m, double rear_m,
                            std::span<const std::uint32_t> later, std::span<const std::uint32_t> earlier) const {
  NearBoth near;
  double least_ahead = kNeighbourReach_m, least_behind = kNeighbourReach_m;
  // `offset` is where the track begins, as seen from the subject's reference point.
  const auto take = [&](std::uint32_t on, double offset, bool ahead, bool behind) {
    const auto placed = on_track_.find(on);
    if (placed == on_track_.end()) return;
    for (const Placed& other : placed->second) {
      const double distance = offset + other.along_m;
      const OtherVehicle& v = *other.vehicle;
      if (ahead && distance > 0.0 && distance < least_ahead) {
        least_ahead = distance;
        near.ahead = {&v, distance - (v.length_m - v.front_m) - front_m};
      }
      if (behind && distance <= 0.0 && -distance < least_behind) {
        least_behind = -distance;
        near.behind = {&v, -distance - v.front_m - rear_m};
      }
    }
  };
  take(track, -along_m, true, true);
  std::uint32_t at = track;
  double offset = -along_m;
  for (int i = 0; i < kMaxTracks; ++i) {
    const auto& links = graph_[at].next;
    const auto next = Preferred(links, later, [](const lanes::Link& link) { return link.to; });
    if (!next) break;
    const auto link = std::ranges::find(links, *next, &lanes::Link::to);
    offset += graph_[at].length_m() - link->from_d_m;
    if (offset > least_ahead) break;
    at = *next;
    take(at, offset, true, false);
  }
  at = track;
  offset = -along_m;
  for (int i = 0; i < kMaxTracks; ++i) {
    const auto before = Preferred(graph_[at].before, earlier, [](std::uint32_t t) { return t; });
    if (!before) break;
    const auto& links = graph_[*before].next;
    const auto link = std::ranges::find(links, at, &lanes::Link::to);
    if (link == links.end()) break;
    if (-offset > least_behind) break;
    offset -= graph_[*before].length_m() - link->from_d_m;
    at = *before;
    take(at, offset, false, true);
  }
  return near;
}

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
// How tracks go on where the file's lanes meet, where they end beside others, where vehicles are gone, and where
// traffic may enter.
#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kBeside_m = 2.3;         // of the middles of a lane that has narrowed to nothing and its neighbour
constexpr double kEnteringWidth_m = 2.0;  // of a lane that traffic enters
constexpr double kEnteringLength_m = 8.0;
constexpr double kLongEnough_m = 40.0;  // of a track that is entered in the middle of the network

}  // namespace

void Graph::AddLink(std::uint32_t from, std::uint32_t to, double to_d_m, bool joins) {
  if (network_->Find(tracks_[from].lane)->traffic_ends) return;
  auto& next = tracks_[from].next;
  if (std::any_of(next.begin(), next.end(), [&](const Link& link) { return link.to == to; })) return;
  const Curve& here = tracks_[from].curve;
  const CurvePoint end = here.At(here.length_m());
  const CurvePoint at = tracks_[to].curve.At(to_d_m);
  const Eigen::Vector2d between = (end.p_W - at.p_W).head<2>();
  const double turned = std::atan2(geometry::Cross(at.ahead_W, end.ahead_W), at.ahead_W.dot(end.ahead_W));
  Link link{to, to_d_m + between.dot(at.ahead_W), geometry::Cross(at.ahead_W, between),
            std::tan(std::clamp(turned, -1.0, 1.0)), joins};
  if (std::fabs(link.from_d_m) < 1e-9) link.from_d_m = 0.0;
  next.push_back(link);
}

// A lane without successor that ends on its neighbour goes on as the neighbour does; a lane without predecessor
// that begins on its neighbour is entered by the vehicles that enter that one.
void Graph::LinkEndingLanes() {
  struct Wanted {
    std::uint32_t from, to;
  };
  std::vector<Wanted> wanted;
  std::vector<bool> entered(tracks_.size(), false);
  for (const Track& track : tracks_) {
    for (const Link& link : track.next) entered[link.to] = true;
  }
  const auto near = [&](std::uint32_t a, std::uint32_t b, bool at_end) {
    const Curve &one = tracks_[a].curve, &other = tracks_[b].curve;
    const Eigen::Vector3d p = at_end ? one.nodes().back().p_W : one.nodes().front().p_W;
    const Eigen::Vector3d q = at_end ? other.nodes().back().p_W : other.nodes().front().p_W;
    return (p - q).norm() < kBeside_m;
  };
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    for (const auto& neighbour : {tracks_[i].left, tracks_[i].right}) {
      if (!neighbour) continue;
      if (tracks_[i].next.empty() && near(i, *neighbour, true)) {
        for (const Link& link : tracks_[*neighbour].next) wanted.push_back({i, link.to});
      }
      if (entered[i] || !near(i, *neighbour, false)) continue;
      for (std::uint32_t k = 0; k < tracks_.size(); ++k) {
        for (const Link& link : tracks_[k].next) {
          if (link.to == *neighbour) wanted.push_back({k, i});
        }
      }
    }
  }
  for (const Wanted& link : wanted) AddLink(link.from, link.to, 0.0, true);
}

// Where the network says it, traffic enters there. Where it says nothing and is open, traffic enters at its edge: where
// nothing leads to a road's lane. A closed one is entered on any lane outside of junctions that is long enough.
void Graph::FindEntries() {
  for (Track& track : tracks_) {
    track.entry = network_->Find(track.lane)->traffic_begins;
    says_entries_ = says_entries_ || track.entry;
  }
  if (says_entries_) return;
  bool any = false;
  for (Track& track : tracks_) {
    const network::RoadSpec& road = network_->roads()[track.lane.road].spec();
    const bool outer = track.along ? track.lane.section == 0 : track.lane.section + 1 == road.sections.size();
    const auto& link = track.along ? road.predecessor : road.successor;
    track.entry = track.before.empty() && outer && !link && track.junction < 0 &&
                  track.length_m() > kEnteringLength_m && track.curve.nodes().front().width_m > kEnteringWidth_m;
    any = any || track.entry;
  }
  for (Track& track : tracks_) {
    if (!any)
      track.entry = track.junction < 0 && track.length_m() > kLongEnough_m &&
                    track.curve.nodes().front().width_m > kEnteringWidth_m;
  }
  any = std::any_of(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.entry; });
  for (Track& track : tracks_) {
    if (!any) track.entry = track.before.empty();
  }
}

}  // namespace rodeira::lanes

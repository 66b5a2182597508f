// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/zones.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/right_of_way.hpp"

namespace rodeira::lanes {
namespace {

constexpr double kMargin_m = 0.15;  // between cars side by side
constexpr double kSpacing_m = 1.0;  // of nodes
constexpr double kApart_m = 8.0;    // two zones of one pair are as far apart
constexpr double kSamePlace_m = 1.0;
constexpr double kSameHeading = 0.95;  // cosine
constexpr double kFollowing_m = 12.0;  // tracks that follow within this distance are no conflict
constexpr double kSplits_m = 1.0;      // between the beginnings of ways on from a lane that splits …
constexpr double kAcross_spm = 2.35;   // … and how long traffic takes across to one of them
constexpr double kLongestSplit_m = 90.0;

// Tracks and how much of a way was left where each was come to at best: rings of short lanes are gone round no second
// time.
using Reached = std::map<std::uint32_t, double>;
bool IsNearer(Reached& reached, std::uint32_t track, double left_m) {
  const auto [at, is_new] = reached.try_emplace(track, left_m);
  if (!is_new && at->second >= left_m) return false;
  at->second = left_m;
  return true;
}

// The tracks that a track's end leads to within a way, or those that lead to its beginning.
void Onward(const Graph& graph, std::uint32_t track, double left_m, Reached& to) {
  for (const Link& link : graph[track].next) {
    if (!IsNearer(to, link.to, left_m)) continue;
    if (const double rest = left_m - graph[link.to].length_m(); rest > 0.0) Onward(graph, link.to, rest, to);
  }
}

void Backward(const Graph& graph, std::uint32_t track, double left_m, Reached& from) {
  for (const std::uint32_t before : graph[track].before) {
    if (!IsNearer(from, before, left_m)) continue;
    if (const double rest = left_m - graph[before].length_m(); rest > 0.0) Backward(graph, before, rest, from);
  }
}

// Whether `to` is reached from the end of `from` within a way.
bool Follows(const Graph& graph, std::uint32_t from, std::uint32_t to, double left_m) {
  Reached reached;
  Onward(graph, from, left_m, reached);
  return reached.contains(to);
}

bool Share(const std::vector<Link>& a, const std::vector<Link>& b) {
  return std::any_of(a.begin(), a.end(), [&](const Link& x) {
    return std::any_of(b.begin(), b.end(), [&](const Link& y) { return x.to == y.to; });
  });
}

bool Share(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t x) { return std::find(b.begin(), b.end(), x) != b.end(); });
}

bool Meet(const Reached& a, const Reached& b) {
  return std::any_of(a.begin(), a.end(), [&](const auto& one) { return b.contains(one.first); });
}

// Whether two tracks that begin in one place are the ends of two ways that come together there, cut into short lane
// sections, and not the beginnings of two that part: they come from different tracks, and go on into one.
bool ComeTogether(const Graph& graph, std::uint32_t a, std::uint32_t b) {
  if (graph[a].before.empty() || graph[b].before.empty()) return false;
  Reached from_a, from_b, to_a, to_b;
  Backward(graph, a, kSamePlace_m, from_a), Backward(graph, b, kSamePlace_m, from_b);
  if (Meet(from_a, from_b)) return false;
  Onward(graph, a, kFollowing_m, to_a), Onward(graph, b, kFollowing_m, to_b);
  return Meet(to_a, to_b);
}

bool SamePlace(const CurvePoint& a, const CurvePoint& b) {
  return (a.p_W - b.p_W).norm() < kSamePlace_m && a.ahead_W.dot(b.ahead_W) > kSameHeading;
}

// How far the largest car reaches beside a node towards a point.
double HalfTowards(const Curve::Node& node, std::size_t index, const Swings& swings, std::uint32_t track,
                   const LargestCar& car, const Eigen::Vector3d& to_W) {
  const double half = HalfSwath_m(node.curvature_1pm, car);
  if (track >= swings.size() || swings[track].empty()) return half;
  const bool left = geometry::Cross(node.along_W.head<2>(), (to_W - node.p_W).head<2>()) > 0.0;
  return std::max(half, left ? swings[track][index].left_m : swings[track][index].right_m);
}

// The pairs of ways on from one lane that begin apart, as where it splits into two, and over how many metres traffic
// comes from its middle onto theirs.
std::map<std::pair<std::uint32_t, std::uint32_t>, double> SplitsOf(const Graph& graph) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> splits;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const auto& next = graph[track].next;
    for (std::size_t i = 0; i < next.size(); ++i) {
      for (std::size_t k = i + 1; k < next.size(); ++k) {
        if (next[i].joins || next[k].joins || std::fabs(next[i].offset_m - next[k].offset_m) < kSplits_m) continue;
        const double across_m = std::max(std::fabs(next[i].offset_m), std::fabs(next[k].offset_m)),
                     speed_mps = graph.SpeedLimit_mps(track, graph[track].length_m());
        double& way_m = splits[{next[i].to, next[k].to}];
        way_m = std::max(way_m, std::min(kLongestSplit_m, kAcross_spm * across_m * speed_mps));
      }
    }
  }
  return splits;
}

}  // namespace

Zones::Zones(const Graph& graph, const LargestCar& car, const Swings& swings) {
  double widest = HalfSwath_m(1.0, car);
  for (const auto& nodes : swings) {
    for (const Swing& swing : nodes) widest = std::max({widest, swing.left_m, swing.right_m});
  }
  const double reach = 2.0 * widest + kMargin_m + kSpacing_m;
  const auto splits = SplitsOf(graph);
  std::vector<NodeKey> near;
  for (std::uint32_t a = 0; a < graph.tracks().size(); ++a) {
    std::map<std::uint32_t, std::vector<Touch>> touches;  // by the other track
    for (std::size_t at = 0; at < graph[a].curve.nodes().size(); ++at) {
      const Curve::Node& node = graph[a].curve.nodes()[at];
      const Eigen::Vector2d p = node.p_W.head<2>();
      graph.Near(p, reach, near);
      for (const NodeKey& key : near) {
        const Curve& other = graph[key.track].curve;
        const Curve::Node& beside = other.nodes()[key.node];
        if (key.track <= a || std::fabs(beside.p_W.z() - node.p_W.z()) > network::Network::kLevel_m) continue;
        const double wide = HalfTowards(node, at, swings, a, car, beside.p_W) +
                            HalfTowards(beside, key.node, swings, key.track, car, node.p_W) + kMargin_m;
        if ((beside.p_W.head<2>() - p).norm() > wide + kSpacing_m) continue;
        const Curve::Foot foot = other.FootNear(p, key.node);
        if ((other.At(foot.d_m).p_W.head<2>() - p).norm() < wide) touches[key.track].push_back({node.d_m, foot.d_m});
      }
    }
    for (auto split = splits.lower_bound({a, 0}); split != splits.end() && split->first.first == a; ++split) {
      const std::uint32_t b = split->first.second;
      const double way_m = std::min({split->second, graph[a].length_m(), graph[b].length_m()});
      std::vector<Touch>& places = touches[b];
      for (double d = 0.0; d <= way_m; d += kSpacing_m) places.push_back({d, d});
      std::stable_sort(places.begin(), places.end(), [](const Touch& x, const Touch& y) { return x.a_m < y.a_m; });
    }
    for (const auto& [b, places] : touches) Pair(graph, a, b, places);
  }
  std::vector<std::vector<ZoneSide>> all(graph.tracks().size()), conflicts(all.size());
  std::vector<std::vector<DivergeZone>> partings(all.size());
  for (std::uint32_t z = 0; z < zones_.size(); ++z) {
    Zone& zone = zones_[z];
    Decide(graph, zone);
    for (int side = 0; side < 2; ++side) {
      const auto mine = static_cast<std::size_t>(side);
      all[zone.track[mine]].push_back({z, side, zone.in_m[mine], zone.out_m[mine], zone.kind});
    }
  }
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    std::stable_sort(all[t].begin(), all[t].end(),
                     [](const ZoneSide& x, const ZoneSide& y) { return x.in_m < y.in_m; });
    for (const ZoneSide& part : all[t]) {
      const Zone& zone = zones_[part.zone];
      const auto theirs = static_cast<std::size_t>(1 - part.side);
      if (part.kind == ZoneKind::kDiverge)
        partings[t].push_back({part.out_m, zone.track[theirs], zone.in_m[theirs], zone.out_m[theirs]});
      else
        conflicts[t].push_back(part);
    }
  }
  all_.Take(all), conflicts_.Take(conflicts), partings_.Take(partings);
}

void Zones::Pair(const Graph& graph, std::uint32_t a, std::uint32_t b, const std::vector<Touch>& touches) {
  if (Follows(graph, a, b, kFollowing_m) || Follows(graph, b, a, kFollowing_m)) return;
  const Curve &one = graph[a].curve, &other = graph[b].curve;
  for (std::size_t i = 0; i < touches.size();) {
    Zone zone;
    zone.track = {a, b};
    zone.in_m = {touches[i].a_m, touches[i].b_m};
    zone.out_m = zone.in_m;
    for (; i < touches.size() && touches[i].a_m - zone.out_m[0] < kApart_m; ++i) {
      zone.out_m[0] = touches[i].a_m;
      zone.in_m[1] = std::min(zone.in_m[1], touches[i].b_m);
      zone.out_m[1] = std::max(zone.out_m[1], touches[i].b_m);
    }
    const std::array<const Curve*, 2> curves{&one, &other};
    for (std::size_t side = 0; side < 2; ++side) {
      zone.in_m[side] = std::max(0.0, zone.in_m[side] - kSpacing_m);
      zone.out_m[side] = std::min(curves[side]->length_m(), zone.out_m[side] + kSpacing_m);
    }
    const bool at_start = zone.in_m[0] <= 0.0 && zone.in_m[1] <= 0.0;
    const bool at_end = zone.out_m[0] >= one.length_m() && zone.out_m[1] >= other.length_m();
    if (at_start && (Share(graph[a].before, graph[b].before) || SamePlace(one.At(0.0), other.At(0.0))))
      zone.kind = ComeTogether(graph, a, b) ? ZoneKind::kMerge : ZoneKind::kDiverge;
    else if (at_end &&
             (Share(graph[a].next, graph[b].next) || SamePlace(one.At(one.length_m()), other.At(other.length_m()))))
      zone.kind = ZoneKind::kMerge;
    zones_.push_back(zone);
  }
}

}  // namespace rodeira::lanes

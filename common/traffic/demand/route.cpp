// SPDX-License-Identifier: Apache-2.0
// The ways of a route.
#include <fmt/format.h>

#include <algorithm>
#include <queue>
#include <tuple>

#include "common/traffic/demand/demand.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLaneChangeRoom_m = 30.0;    // a lane change takes this length with marks that allow it …
constexpr double kTightChangeRoom_m = 20.0;   // … or that of a shorter track, if that is no less
constexpr double kMarkSamplingStep_m = 10.0;  // between two places at which the marks are checked
constexpr double kLaterIsLonger_m = 30.0;     // at most, a way with a later change, as by the lanes of a bend

bool MayChange(const lanes::Graph& graph, const lanes::EdgeMarks& marks, std::uint32_t track, lanes::Side side) {
  if (!(side == lanes::Side::kLeft ? graph[track].left : graph[track].right)) return false;
  const double room = std::clamp(graph[track].length_m(), kTightChangeRoom_m, kLaneChangeRoom_m);
  for (double d = 0.0; d + room <= graph[track].length_m(); d += kMarkSamplingStep_m) {
    if (marks.MayCross(track, side, d, d + room)) return true;
  }
  return false;
}

}  // namespace

base::Result<Route> Route::Make(const lanes::Graph& graph, const lanes::EdgeMarks& marks,
                                const RouteSettings& settings) {
  Route route;
  const std::size_t count = graph.tracks().size(), legs = settings.ways.size();
  std::vector<std::vector<std::uint32_t>> on;
  for (const std::string& way : settings.ways) {
    auto tracks = TracksOf(graph, way, settings.place);
    if (!tracks) return tracks.error();
    route.reached_.emplace_back(count, false);
    for (const std::uint32_t track : tracks.value()) route.reached_.back()[track] = true;
    on.push_back(std::move(tracks).value());
  }
  route.left_.assign(legs + 1, std::vector<Left>(count));
  for (Left& left : route.left_[legs]) left.left_m = 0.0;
  for (std::size_t leg = legs; leg-- > 0;) {
    route.FindWays(graph, marks, static_cast<std::uint32_t>(leg));
    if (leg == 0) break;
    const bool any = std::any_of(on[leg - 1].begin(), on[leg - 1].end(), [&](std::uint32_t track) {
      return route.Reaches(static_cast<std::uint32_t>(leg), track);
    });
    if (!any) {
      return base::WrongInput("traffic.no_way",
                              fmt::format("the route '{}' does not exist: no way leads from '{}' on to '{}'",
                                          settings.name, settings.ways[leg - 1], settings.ways[leg]),
                              settings.place);
    }
  }
  return route;
}

// Dijkstra's shortest ways, backward from the road that the leg leads to.
void Route::FindWays(const lanes::Graph& graph, const lanes::EdgeMarks& marks, std::uint32_t leg) {
  auto& left = left_[leg];
  using Open = std::tuple<double, std::uint32_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  const auto improve = [&](std::uint32_t track, const Left& by) {
    if (by.left_m >= left[track].left_m) return;
    left[track] = by;
    open.emplace(by.left_m, track);
  };
  for (std::uint32_t track = 0; track < left.size(); ++track) {
    if (reached_[leg][track] && Reaches(leg + 1, track)) improve(track, left_[leg + 1][track]);
  }
  while (!open.empty()) {
    const auto [way_m, track] = open.top();
    open.pop();
    if (way_m > left[track].left_m) continue;
    const Left here = left[track];
    for (const std::uint32_t before : graph[track].before) {
      if (!reached_[leg][before]) improve(before, {way_m + graph[before].length_m(), here.changes, false});
    }
    for (const auto& [beside, side] :
         {std::pair{graph[track].left, lanes::Side::kRight}, {graph[track].right, lanes::Side::kLeft}}) {
      if (beside && !reached_[leg][*beside] && MayChange(graph, marks, *beside, side))
        improve(*beside, {way_m + kChange_m, here.changes + 1, true});
    }
  }
  for (std::uint32_t track = 0; track < left.size();
       ++track) {  // one that may as well change later does not have to now
    const auto& next = graph[track].next;
    if (left[track].must_change && std::any_of(next.begin(), next.end(), [&](const lanes::Link& on) {
          return left[on.to].changes == left[track].changes &&
                 left[on.to].left_m + graph[track].length_m() <= left[track].left_m + kLaterIsLonger_m;
        }))
      left[track].must_change = false;
  }
}

std::uint32_t Route::LegOn(std::uint32_t leg, std::uint32_t track) const {
  while (leg < legs() && reached_[leg][track]) ++leg;
  return leg;
}

std::optional<std::size_t> Route::LinkOn(const lanes::Graph& graph, std::uint32_t leg, std::uint32_t track) const {
  if (leg >= legs()) return std::nullopt;
  std::optional<std::size_t> best;
  const auto& next = graph[track].next;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (Reaches(leg, next[i].to) && (!best || At(leg, next[i].to).left_m < At(leg, next[*best].to).left_m)) best = i;
  }
  return best;
}

}  // namespace rodeira::traffic

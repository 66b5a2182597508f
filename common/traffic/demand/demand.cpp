// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/demand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common/core/base/suggest.hpp"

namespace rodeira::traffic {
namespace {

base::Result<std::uint32_t> FirstTrackOf(const lanes::Graph& graph, const std::string& lane, const std::string& place) {
  const auto tracks = TracksOf(graph, lane, place);
  if (!tracks) return tracks.error();
  return tracks.value().front();
}

// By what chance the links of a track are taken.
base::Result<std::vector<double>> SharesOf(const lanes::Graph& graph, std::uint32_t track, const TurnSettings& turn) {
  const auto& next = graph[track].next;
  std::vector<double> shares(next.size(), 0.0);
  for (const auto& [way, share] : turn.shares) {
    const auto to = TracksOf(graph, way, turn.place);
    if (!to) return to.error();
    bool leads = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (std::find(to.value().begin(), to.value().end(), next[i].to) == to.value().end()) continue;
      shares[i] += share;
      leads = true;
      break;
    }
    if (!leads)
      return base::WrongInput("traffic.no_way", fmt::format("the lane '{}' does not go on into '{}'", turn.lane, way),
                              turn.place);
  }
  double sum = 0.0;
  for (const double share : shares) sum += share;
  if (sum <= 0.0)
    return base::WrongInput("traffic.no_way",
                            fmt::format("no way on from the lane '{}' has a share above 0", turn.lane), turn.place);
  double up_to = 0.0;
  for (double& share : shares) share = up_to += share / sum;
  return shares;
}

base::Result<std::int64_t> RouteNamed(const DemandSettings& settings, const FlowSettings& flow) {
  if (flow.route.empty()) return std::int64_t{-1};
  std::vector<std::string> known;
  for (std::size_t r = 0; r < settings.routes.size(); ++r) {
    if (settings.routes[r].name == flow.route) return static_cast<std::int64_t>(r);
    known.push_back(settings.routes[r].name);
  }
  return base::WrongInput("traffic.unknown_route",
                          fmt::format("the route '{}' does not exist; one of 'routes' was expected{}", flow.route,
                                      base::DidYouMean(flow.route, known)),
                          flow.place);
}

}  // namespace

base::Result<Demand> Demand::Make(const lanes::Graph& graph, const lanes::EdgeMarks& marks,
                                  const DemandSettings& settings) {
  Demand demand;
  for (const RouteSettings& route_settings : settings.routes) {
    auto route = Route::Make(graph, marks, route_settings);
    if (!route) return route.error();
    demand.routes_.push_back(std::move(route).value());
  }
  for (const FlowSettings& flow_settings : settings.flows) {
    Flow flow;
    if (!flow_settings.lane.empty()) {
      const auto track = FirstTrackOf(graph, flow_settings.lane, flow_settings.place);
      if (!track) return track.error();
      flow.track = track.value();
    }
    const auto number = RouteNamed(settings, flow_settings);
    if (!number) return number.error();
    flow.route = number.value();
    if (flow.route >= 0) {
      if (flow.track < 0)
        return base::WrongInput(
            "traffic.no_lane_named",
            fmt::format("the flow of the route '{}' names no lane; the lane where it enters was expected",
                        flow_settings.route),
            flow_settings.place);
      const Route& route = demand.route(flow.route);
      const auto track = static_cast<std::uint32_t>(flow.track);
      if (!route.Reaches(route.LegOn(0, track), track)) {
        return base::WrongInput(
            "traffic.no_way",
            fmt::format("the route '{}' does not exist from the lane '{}': no way leads from there to '{}'",
                        flow_settings.route, flow_settings.lane,
                        settings.routes[static_cast<std::size_t>(flow.route)].ways.front()),
            flow_settings.place);
      }
    }
    demand.flows_.push_back(flow);
  }
  if (!settings.turns.empty()) demand.shares_.resize(graph.tracks().size());
  std::map<std::uint32_t, const TurnSettings*> told;  // by the track at the end of which they turn
  for (const TurnSettings& turn : settings.turns) {
    auto tracks = TracksOf(graph, turn.lane, turn.place);
    if (!tracks) return tracks.error();
    const std::uint32_t last = tracks.value().back();
    if (const auto [before, is_first] = told.emplace(last, &turn); !is_first) {
      return base::WrongInput(
          "traffic.duplicate_turns",
          fmt::format("the lane '{}' has turns already, as '{}'{}; one item a lane was expected", turn.lane,
                      before->second->lane, before->second->place.empty() ? "" : " in " + before->second->place),
          turn.place);
    }
    auto shares = SharesOf(graph, last, turn);
    if (!shares) return shares.error();
    demand.shares_[last] = std::move(shares).value();
  }
  return demand;
}

}  // namespace rodeira::traffic

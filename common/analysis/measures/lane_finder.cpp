// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

// The nearest driving lane of the section, from `lane` towards the road's centre; nothing where there is none.
std::optional<network::LaneKey> DrivingLaneInside(const network::Network& network, network::LaneKey key) {
  const int step = key.lane > 0 ? -1 : 1;
  for (; key.lane != 0; key.lane += step) {
    const network::Lane* lane = network.Find(key);
    if (lane != nullptr && network::IsDrivable(lane->type)) return key;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LanePlace> LaneFinder::Find(double x_m, double y_m, double z_m, double heading_rad,
                                          network::Hint& hint) const {
  const network::Network& network = graph_.network();
  const auto place = network.Locate(x_m, y_m, z_m, &hint);
  if (!place || place->lane.lane == 0) return std::nullopt;
  const auto key = DrivingLaneInside(network, place->lane);
  if (!key) return std::nullopt;
  const auto span = network.Span(*key, place->s_m);
  if (!span || !(span->width_m() > 0.0)) return std::nullopt;
  // Beside the lanes t is that of the nearest point of the road: the distance from there counts, too.
  const double beyond = std::abs(place->t_m - span->centre_t_m()) - 0.5 * span->width_m() + place->distance_m;
  if (beyond > span->width_m()) return std::nullopt;
  const network::Road& road = network.roads()[key->road];
  const geometry::PlanPoint axis = road.axis().Evaluate(place->s_m);
  const double slope = 0.5 * (span->inner_slope + span->outer_slope);
  const double centre_t = span->centre_t_m();
  LanePlace found;
  found.lane = *key;
  found.s_m = place->s_m;
  found.t_m = place->t_m;
  found.width_m = span->width_m();
  found.junction = !road.spec().junction.empty();
  // The lane's middle runs askew to the axis by its slope.
  const double lane_heading = axis.heading_rad + std::atan2(slope, 1.0 - axis.curvature_1pm * centre_t);
  const double error = WrapAngle(heading_rad - lane_heading);
  found.along_s = std::abs(error) <= 0.5 * std::numbers::pi;
  const double side = found.along_s ? 1.0 : -1.0;
  found.position_m = side * (place->t_m - centre_t);
  found.heading_error_rad = found.along_s ? error : WrapAngle(error - std::numbers::pi);
  found.curvature_1pm = side * axis.curvature_1pm / (1.0 - axis.curvature_1pm * centre_t);
  const auto limit = road.SpeedLimitAt(*network.Find(*key), place->s_m);
  if (limit && std::isfinite(*limit)) found.speed_limit_mps = limit;
  if (const auto track = graph_.Find(*key)) {
    found.track = *track;
    found.along_m = graph_[*track].curve.AtStation(place->s_m);
  }
  return found;
}

std::optional<LaneFinder::OnTrack> LaneFinder::FindTrack(double x_m, double y_m, double z_m,
                                                         network::Hint& hint) const {
  const auto place = graph_.network().Locate(x_m, y_m, z_m, &hint);
  if (!place || place->distance_m > 0.0) return std::nullopt;
  const auto track = graph_.Find(place->lane);
  if (!track) return std::nullopt;
  return OnTrack{*track, graph_[*track].curve.AtStation(place->s_m)};
}

int SideOf(const network::Network& network, const LanePlace& from, const LanePlace& to) {
  if (from.lane.road != to.lane.road || from.lane == to.lane) return 0;
  const auto from_span = network.Span({to.lane.road, to.lane.section, from.lane.lane}, to.s_m);
  const auto to_span = network.Span(to.lane, to.s_m);
  if (!from_span || !to_span) return 0;
  const double apart = to_span->centre_t_m() - from_span->centre_t_m();
  if (apart == 0.0 || std::abs(apart) > 0.75 * (from_span->width_m() + to_span->width_m())) return 0;
  return (apart > 0.0) == to.along_s ? 1 : -1;
}

bool GoesOn(const lanes::Graph& graph, const LanePlace& from, const LanePlace& to) {
  if (from.lane == to.lane) return true;
  if (from.track < 0 || to.track < 0) return false;
  const auto leads = [&graph](std::int64_t a, std::int64_t b) {
    return std::ranges::any_of(graph[static_cast<std::uint32_t>(a)].next,
                               [b](const lanes::Link& link) { return link.to == b && !link.joins; });
  };
  return leads(from.track, to.track) || leads(to.track, from.track);
}

}  // namespace rodeira::measures

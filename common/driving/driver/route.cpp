// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/route.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/geometry/angle.hpp"

namespace rodeira::driver {
namespace {

using network::LaneEnd;
using network::LaneKey;
using network::Network;

constexpr double kSample_m = 4.0;
constexpr double kApart_m = 4.0;    // of the middles of two lanes that do not touch, about
constexpr double kRecent_m = 30.0;  // of the route behind, which the next lane may touch

double LengthOf(const Network& network, const LaneKey& lane) {
  const network::LaneSection& section = network.Section(lane);
  return section.end_s_m - section.s_m;
}

// Points of a leg's middle, in the direction in which it is driven.
std::vector<Eigen::Vector3d> Middle(const Network& network, const RouteLeg& leg) {
  const network::LaneSection& section = network.Section(leg.lane);
  const double length = LengthOf(network, leg.lane);
  const int count = 1 + static_cast<int>(length / kSample_m);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= count; ++i)
    points.push_back(
        network.Centre(leg.lane, leg.along ? section.s_m + length * i / count : section.end_s_m - length * i / count));
  return points;
}

// How far a leg turns from beginning to end.
double Turn(const Network& network, const RouteLeg& leg) {
  const network::LaneSection& section = network.Section(leg.lane);
  const geometry::PlanAxis& axis = network.roads()[leg.lane.road].axis();
  return std::fabs(
      geometry::WrapAngle(axis.Evaluate(section.end_s_m).heading_rad - axis.Evaluate(section.s_m).heading_rad));
}

bool ComesBack(const std::vector<Eigen::Vector3d>& route, const std::vector<Eigen::Vector3d>& leg) {
  const auto recent = static_cast<std::size_t>(kRecent_m / kSample_m);
  for (std::size_t i = 0; i + recent < route.size(); ++i) {
    for (const Eigen::Vector3d& p : leg) {
      if ((route[i] - p).head<2>().norm() < kApart_m && std::fabs(route[i].z() - p.z()) < Network::kLevel_m)
        return true;
    }
  }
  return false;
}

}  // namespace

std::vector<RouteLeg> StraightOn(const Network& network, const LaneKey& start, double length_m) {
  std::vector<RouteLeg> legs{{start, network.Find(start)->direction >= 0}};
  std::vector<Eigen::Vector3d> points = Middle(network, legs[0]);
  double length = LengthOf(network, start);
  while (length < length_m) {
    const RouteLeg& last = legs.back();
    std::optional<RouteLeg> next;
    for (const LaneEnd& end : last.along ? network.AtEnd(last.lane) : network.AtStart(last.lane)) {
      const RouteLeg leg{end.lane, end.end == network::End::kStart};
      const network::Lane& lane = *network.Find(leg.lane);
      if (!network::IsDrivable(lane.type) || !network::OpenToCars(lane) || lane.direction == (leg.along ? -1 : 1))
        continue;
      if (!next || Turn(network, leg) < Turn(network, *next)) next = leg;
    }
    if (!next) break;
    const auto middle = Middle(network, *next);
    if (ComesBack(points, middle)) break;
    legs.push_back(*next);
    points.insert(points.end(), middle.begin(), middle.end());
    length += LengthOf(network, next->lane);
  }
  return legs;
}

}  // namespace rodeira::driver

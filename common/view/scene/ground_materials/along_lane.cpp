// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/ground_materials/along_lane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::scene {
namespace {

constexpr double kReach_m = 1.0;  // panels are looked for so far around a point
constexpr double kBeside = 1e4;   // so many metres along the lane count less than one beside it or past a panel's end

}  // namespace

Eigen::Vector2d OnRoad(const network::Network& network, const AlongLane& place, const Eigen::Vector2d& p_W) {
  const network::Road& road = network.roads()[place.lane.road];
  const network::LaneSection& section = network.Section(place.lane);
  Eigen::Vector2d best(std::clamp(place.s_m, section.s_m, section.end_s_m), 0.0);
  double best_cost = std::numeric_limits<double>::infinity();
  network.Near(p_W, kReach_m, [&](std::uint32_t index, std::uint32_t panel_index) {
    if (index != place.lane.road) return;
    const geometry::AxisPanel& panel = road.axis().panels()[panel_index];
    if (panel.end_s_m() < section.s_m || panel.begin_s_m() > section.end_s_m) return;
    const geometry::AxisFoot foot = road.axis().Foot(panel, p_W);
    double s_m = std::clamp(panel.middle_s_m + foot.u_m, section.s_m, section.end_s_m), t_m = foot.t_m;
    if (road.rolled()) road.Settle(p_W, section.s_m, section.end_s_m, s_m, t_m);
    const auto span = network.Span(place.lane, s_m);
    if (!span) return;
    const auto [right_m, left_m] = std::minmax(span->inner_t_m, span->outer_t_m);
    const double beside_m = std::max({0.0, right_m - t_m, t_m - left_m, std::fabs(foot.beyond_m)});
    const double cost = std::fabs(s_m - place.s_m) + kBeside * beside_m;
    if (cost < best_cost) best_cost = cost, best = {s_m, t_m};
  });
  return best;
}

Eigen::Vector2d OnPicture(const network::Network& network, const AlongLane& place, const terrain::LaidPicture& picture,
                          const Eigen::Vector2d& p_W) {
  const network::Lane* lane = network.Find(place.lane);
  const Eigen::Vector2d on_road = OnRoad(network, place, p_W);
  const auto span = network.Span(place.lane, on_road.x());
  const double inner_m = span ? span->inner_t_m : 0.0;
  const double ahead = lane != nullptr && lane->direction < 0 ? -1.0 : 1.0;
  return ahead * Eigen::Vector2d((inner_m - on_road.y()) / picture.width_m,
                                 (on_road.x() - network.Section(place.lane).s_m) / picture.height_m);
}

}  // namespace rodeira::scene

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/network/tight_bends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/traffic/motion/car_of.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHand_m = 0.1;
constexpr std::array kNames{"car", "van", "lorry", "bus"};

// The worst of one body on a track; none: off_m below 0.
TightBend WorstOn(const lanes::Graph& graph, std::uint32_t track, std::uint32_t body) {
  const AgentTraits traits = TraitsOfBody(body);
  const double base = traits.wheelbase_m;
  const dynamics::BicycleSettings& car = CarOfBody(body);
  const lanes::Curve& curve = graph[track].curve;
  TightBend worst{body, track, 0.0, 0.0, 0.0, -1.0, true, 0};
  for (double from = 0.0; from + base <= curve.length_m(); from += 0.5) {
    const Eigen::Vector2d rear = curve.At(from).ahead_W, front = curve.At(from + base).ahead_W;
    const double bends_1pm = std::fabs(std::atan2(rear.x() * front.y() - rear.y() * front.x(), rear.dot(front))) / base;
    const double at = from + 0.5 * base, width = curve.WidthAt(at);
    const double off = 0.5 * traits.width_m + 0.25 * base * base * bends_1pm - 0.5 * width;
    const bool turns = std::atan(base * bends_1pm) <= car.steering.limit_rad / car.steering.ratio;
    if (bends_1pm > 0.0 && off > worst.off_m && (off > kHand_m || !turns))
      worst = {body, track, at, 1.0 / bends_1pm, width, off, turns, 0};
  }
  return worst;
}

}  // namespace

std::vector<TightBend> TightBendsOf(const lanes::Graph& graph, const TrafficSettings& settings) {
  std::vector<TightBend> bends;
  if (settings.physics != Physics::kFull) return bends;
  for (const std::uint32_t body : BodiesOf(settings)) {
    TightBend worst{body, 0, 0.0, 0.0, 0.0, -1.0, true, 0};
    std::size_t lanes = 0;
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const TightBend here = WorstOn(graph, track, body);
      if (here.radius_m <= 0.0) continue;
      ++lanes;
      if (here.off_m > worst.off_m) worst = here;
    }
    worst.lanes = lanes;
    if (lanes > 0) bends.push_back(worst);
  }
  return bends;
}

std::string Text(const TightBend& bend, const lanes::Graph& graph) {
  const AgentTraits traits = TraitsOfBody(bend.body);
  const network::LaneKey& lane = graph[bend.track].lane;
  const std::string off =
      bend.off_m > kHand_m ? fmt::format(": {:.2f} m off to either side", bend.off_m) : std::string();
  return fmt::format(
      "{} lane{} too {} in {} bends for the wheels of a {} of {:.1f} m; the worst: road '{}', lane {}, {:.1f} m on, "
      "radius {:.1f} m{}, {:.2f} m wide{}",
      bend.lanes, bend.lanes == 1 ? " is" : "s are", bend.turns ? "narrow" : "narrow or too tight",
      bend.lanes == 1 ? "its" : "their", kNames[static_cast<std::size_t>(traits.kind)], traits.length_m,
      graph.network().roads()[lane.road].id(), lane.lane, bend.d_m, bend.radius_m,
      bend.turns ? "" : ", to which they do not turn", bend.width_m, off);
}

}  // namespace rodeira::traffic

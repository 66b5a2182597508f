// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/lights.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "common/core/geometry/plane.hpp"
#include "common/world/lanes/approach.hpp"
#include "common/world/lanes/signs.hpp"

namespace rodeira::lanes {
namespace {

// The controller with times that a signal obeys.
std::optional<std::uint32_t> ControllerOf(const network::Network& network, const std::string& signal) {
  for (std::uint32_t i = 0; i < network.controllers().size(); ++i) {
    const network::Controller& controller = network.controllers()[i];
    if (!controller.times) continue;
    for (const network::ControllerEntry& entry : controller.controls) {
      if (entry.signal_id == signal) return i;
    }
  }
  return std::nullopt;
}

bool OnFoot(const network::Network& network, const std::string& id) {
  for (const network::Road& road : network.roads()) {
    for (const network::Signal& signal : road.spec().signals) {
      if (signal.id == id) return signal.type == network::kPedestrianSignal;
    }
  }
  return false;
}

std::string Named(const Graph& graph, const LightPlace& light) {
  const network::Controller& controller = graph.network().controllers()[light.controller];
  const network::LaneKey& lane = graph[light.track].lane;
  return "'" + (controller.name.empty() ? controller.id : controller.name) + "' (signal " + light.signal + ", road '" +
         graph.network().roads()[lane.road].id() + "', lane " + std::to_string(lane.lane) + ")";
}

// Not from the same side, and not from opposite ones.
bool FromDifferentSides(const Graph& graph, const LightPlace& a, const LightPlace& b) {
  const Eigen::Vector2d from_a = graph[a.track].curve.At(a.d_m).ahead_W,
                        from_b = graph[b.track].curve.At(b.d_m).ahead_W;
  const double turned = std::fabs(std::atan2(geometry::Cross(from_a, from_b), from_a.dot(from_b)));
  return turned >= kSameDirection_rad && turned <= kHeadOn_rad;
}

}  // namespace

std::vector<LaneLight> LightsOfLane(const network::Network& network, const network::LaneKey& lane, bool along,
                                    double low_s_m, double high_s_m) {
  std::vector<LaneLight> lights;
  if (network.controllers().empty()) return lights;
  const network::RoadSpec& road = network.roads()[lane.road].spec();
  const auto add = [&](const std::string& id, double s_m) {
    const auto controller = ControllerOf(network, id);
    if (controller && s_m >= low_s_m && s_m <= high_s_m) lights.push_back({s_m, *controller, id});
  };
  for (const network::Signal& signal : road.signals) {
    if (signal.type != network::kPedestrianSignal && HoldsFor(lane.lane, along, signal.orientation, signal.validity))
      add(signal.id, signal.s_m);
  }
  for (const network::SignalReference& reference : road.signal_references) {
    if (HoldsFor(lane.lane, along, reference.orientation, reference.validity) && !OnFoot(network, reference.id))
      add(reference.id, reference.s_m);
  }
  std::stable_sort(lights.begin(), lights.end(), [](const LaneLight& a, const LaneLight& b) { return a.s_m < b.s_m; });
  return lights;
}

std::vector<LightPlace> LightsOf(const Graph& graph, std::uint32_t track) {
  const Track& t = graph[track];
  const double begin = t.curve.nodes().front().s_m, end = t.curve.nodes().back().s_m;
  std::vector<LightPlace> lights;
  for (LaneLight& light : LightsOfLane(graph.network(), t.lane, t.along, std::min(begin, end), std::max(begin, end))) {
    lights.push_back(
        {(light.s_m - begin) / (end - begin) * t.length_m(), light.controller, std::move(light.signal), track});
  }
  std::stable_sort(lights.begin(), lights.end(),
                   [](const LightPlace& a, const LightPlace& b) { return a.d_m < b.d_m; });
  return lights;
}

std::optional<LightPlace> LightFor(const Graph& graph, std::uint32_t track, double d_m) {
  double back = 0.0;
  while (true) {
    const auto lights = LightsOf(graph, track);
    for (auto light = lights.rbegin(); light != lights.rend(); ++light) {
      if (light->d_m <= d_m + kPastZoneBegin_m) return *light;
    }
    back += d_m;
    if (back > kMaxUpstream_m || graph[track].before.size() != 1) return std::nullopt;
    track = graph[track].before.front();
    d_m = graph[track].length_m();
  }
}

std::vector<std::string> DarkControllers(const network::Network& network) {
  std::set<std::string, std::less<>> for_vehicles;
  for (const network::Road& road : network.roads()) {
    for (const network::Signal& signal : road.spec().signals) {
      if (signal.type != network::kPedestrianSignal) for_vehicles.insert(signal.id);
    }
  }
  std::vector<std::string> dark;
  for (const network::Controller& controller : network.controllers()) {
    const bool controls =
        std::any_of(controller.controls.begin(), controller.controls.end(),
                    [&](const network::ControllerEntry& entry) { return for_vehicles.contains(entry.signal_id); });
    if (controls && !controller.times) dark.push_back(controller.id);
  }
  return dark;
}

std::optional<GreenTogether> FindGreenTogether(const Graph& graph, const Zones& zones) {
  for (const Zone& zone : zones.zones()) {
    if (zone.kind == ZoneKind::kDiverge) continue;
    const auto a = LightFor(graph, zone.track[0], zone.in_m[0]), b = LightFor(graph, zone.track[1], zone.in_m[1]);
    if (!a || !b) continue;
    const auto& controllers = graph.network().controllers();
    if (!network::MeetGreen(*controllers[a->controller].times, *controllers[b->controller].times)) continue;
    if (!FromDifferentSides(graph, *a, *b)) continue;
    return GreenTogether{{a->controller, b->controller},
                         "the lights " + Named(graph, *a) + " and " + Named(graph, *b) +
                             " are green or amber together, and their ways " +
                             (zone.kind == ZoneKind::kMerge ? "merge" : "cross") +
                             "; phases that do not meet were expected"};
  }
  return std::nullopt;
}

std::vector<std::array<std::uint32_t, 2>> ConflictingControllers(const Graph& graph, const Zones& zones) {
  std::set<std::array<std::uint32_t, 2>> pairs;
  for (const Zone& zone : zones.zones()) {
    if (zone.kind == ZoneKind::kDiverge) continue;
    const auto a = LightFor(graph, zone.track[0], zone.in_m[0]), b = LightFor(graph, zone.track[1], zone.in_m[1]);
    if (a && b && a->controller != b->controller && FromDifferentSides(graph, *a, *b))
      pairs.insert({std::min(a->controller, b->controller), std::max(a->controller, b->controller)});
  }
  return {pairs.begin(), pairs.end()};
}

base::Status CheckLights(const Graph& graph, const Zones& zones) {
  const auto where = [&](const std::string& place) {
    return place.empty() ? "network '" + graph.network().name() + "'" : place;
  };
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    for (const LightPlace& light : LightsOf(graph, track)) {
      const network::Controller& controller = graph.network().controllers()[light.controller];
      if (controller.times->green_s > 0.0) continue;
      return base::WrongInput("world.wrong_signals",
                              "the light " + Named(graph, light) + " is never green; a time of green was expected",
                              where(controller.place));
    }
  }
  const auto together = FindGreenTogether(graph, zones);
  if (!together) return {};
  // At the later of the two: it is green although the other one is.
  const std::string& place =
      graph.network().controllers()[std::max(together->controllers[0], together->controllers[1])].place;
  return base::WrongInput("world.wrong_signals", together->sentence, where(place));
}

}  // namespace rodeira::lanes

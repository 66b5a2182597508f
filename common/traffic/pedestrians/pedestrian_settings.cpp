// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/pedestrians/pedestrian_settings.hpp"

#include <fmt/format.h>

namespace rodeira::traffic {
namespace {

constexpr double kMost_ph = 5000.0, kFarthest_m = 1e7;

}  // namespace

PedestrianSettings ReadPedestrians(const config::Map& map) {
  PedestrianSettings people;
  people.place = map.Place();
  people.per_h = map.Number("per_hour", {0.0, kMost_ph}, people.per_h);
  people.slowest_mps = map.Number("slowest_mps", {0.3, 3.0}, people.slowest_mps);
  people.fastest_mps = map.Number("fastest_mps", {0.3, 3.0}, people.fastest_mps);
  if (people.fastest_mps < people.slowest_mps) {
    map.Problem(
        map.Has("fastest_mps") ? "fastest_mps" : "slowest_mps", "config.wrong_order",
        fmt::format("'fastest_mps' is {}, below 'slowest_mps', which is {}", people.fastest_mps, people.slowest_mps));
  }
  const config::List list = map.OptionalItems("at");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const config::Map item = list.At(i);
    people.at.push_back({item.Text("road"), item.Number("s_m", {0.0, kFarthest_m}),
                         item.Number("per_hour", {0.0, kMost_ph}), item.Place()});
  }
  return people;
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/pedestrians/pedestrian_settings.hpp"

#include <fmt/format.h>

#include "common/core/config/declared.hpp"
#include "common/traffic/pedestrians/pedestrian_schema.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMost_ph = 5000.0, kFarthest_m = 1e7;

}  // namespace

const std::vector<config::Key>& PedestrianKeys() {
  static const PedestrianSettings usual;
  static const std::vector<config::Key> keys{
      config::NumberKey("per_hour", {0.0, kMost_ph}, usual.per_h, "Pedestrians to each crossing."),
      config::NumberKey("slowest_mps", {0.3, 3.0}, usual.slowest_mps, "Lowest walking speed."),
      config::NumberKey("fastest_mps", {0.3, 3.0}, usual.fastest_mps, "Highest walking speed; not below the lowest."),
      config::ListKey("at",
                      {config::RequiredTextKey("road", "main", "Road of the crossing."),
                       config::RequiredNumberKey("s_m", {0.0, kFarthest_m}, "Station; the nearest crossing is meant."),
                       config::RequiredNumberKey("per_hour", {0.0, kMost_ph}, "Pedestrians to this crossing.")},
                      "Other numbers at some crossings.")};
  return keys;
}

PedestrianSettings ReadPedestrians(const config::Map& map) {
  PedestrianSettings people;
  people.place = map.Place();
  const config::DeclaredMap declared(map, PedestrianKeys());
  people.per_h = declared.Number("per_hour");
  people.slowest_mps = declared.Number("slowest_mps");
  people.fastest_mps = declared.Number("fastest_mps");
  if (people.fastest_mps < people.slowest_mps) {
    map.Problem(
        map.Has("fastest_mps") ? "fastest_mps" : "slowest_mps", "config.wrong_order",
        fmt::format("'fastest_mps' is {}, below 'slowest_mps', which is {}", people.fastest_mps, people.slowest_mps));
  }
  const config::DeclaredList list = declared.Items("at");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const config::DeclaredMap item = list.At(i);
    people.at.push_back({item.Text("road"), item.Number("s_m"), item.Number("per_hour"), item.map().Place()});
  }
  return people;
}

}  // namespace rodeira::traffic

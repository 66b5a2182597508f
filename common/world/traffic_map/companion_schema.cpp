// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/companion_schema.hpp"

#include <cstdint>

#include "common/world/lights/light_schema.hpp"
#include "common/world/traffic_map/heights.hpp"

namespace rodeira::traffic_map {
namespace {

config::Key SignsKey() {
  std::vector<std::string> kinds;
  for (int i = 0; i < kSignKinds; ++i) kinds.emplace_back(NameOf(static_cast<SignKind>(i)));
  const std::string first = kinds.front();
  return config::ListKey(
      "signs",
      {config::RequiredIntegerKey("lane", INT32_MIN, INT32_MAX, "Number of the lane."),
       config::Required(config::WordKey("kind", std::move(kinds), first, "What it says.")),
       config::NumberKey("before_end_m", {0.0, 1e5}, 0.0, "How far it stands before the lane's end."),
       config::WithDefaultNote("required for `speed_limit`",
                               config::OptionalNumberKey("limit_kmh", {5.0, 200.0}, "Speed limit."))},
      "Signs at lanes.");
}

}  // namespace

const config::Schema& CompanionSchema() {
  static const config::Schema schema{
      "motors", "motors/1", "What a .motors file cannot say: heights, lights, signs, flows.",
      config::FileKeys(
          "motors/1",
          {config::WordKey("rule", {"right", "left"}, "right", "Side of the road that is driven on."),
           config::WithSample(
               "3", config::NamedValueKey("heights_m",
                                          config::Counted(4, 4,
                                                          config::ListKey("", config::NumberItem({-1e4, 1e4}),
                                                                          "z at the four control points.")),
                                          "Heights, by number of a curve; other curves lie at 0.")),
           config::ListKey("lights", lights::LightPlanKeys(), "Lights, one plan a junction; names are lanes."),
           SignsKey(),
           config::WithSample("1", config::NamedValueKey("flows_vehph", config::NumberItem({0.0, 10'000.0}),
                                                         "Vehicles an hour, by number of a start lane."))})};
  return schema;
}

}  // namespace rodeira::traffic_map

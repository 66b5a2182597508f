// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_schema.hpp"

#include "common/world/design/common_keys.hpp"
#include "common/world/lights/light_schema.hpp"

namespace rodeira::design {

const std::vector<config::Key>& JunctionKeys() {
  using config::NumberKey;
  using config::WithDefaultNote;
  static const std::vector<config::Key> keys{
      config::RequiredTextKey("id", "corner", "Id, without '/'."),
      config::ComputedTextKey("name", "the id", "Mill corner", "Name, for the reader."),
      config::Required(config::Counted(
          2, kAnyNumber,
          config::ListKey("roads",
                          {config::RequiredTextKey("road", "main", "Road."),
                           config::ComputedNumberKey("s_m", config::Range::NotNegative(), "or `end`",
                                                     "Station where the road passes."),
                           WithDefaultNote("or `s_m`", config::OptionalWordKey("end", {"start", "end"},
                                                                               "End of the road that lies there."))},
                          "Roads that meet; the first one has priority."))),
      config::WordKey("control", {"give_way", "stop", "none", "lights"}, "give_way", "What holds for the other roads."),
      config::MappingKey("lights", lights::LightPlanKeys(), "Lights, for `control: lights`."),
      NumberKey("radius_m", {1.0, 100.0}, 8.0, "How far the corners stand back."),
      NumberKey("fit_m", {1.0, 1000.0}, 60.0, "Length over which other roads come to the first one's height.")};
  return keys;
}

}  // namespace rodeira::design

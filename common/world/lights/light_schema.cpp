// SPDX-License-Identifier: Apache-2.0
#include "common/world/lights/light_schema.hpp"

#include <limits>

#include "common/world/lights/light_plan.hpp"

namespace rodeira::lights {

const std::vector<config::Key>& LightPlanKeys() {
  using config::NumberKey;
  using config::Required;
  const LightPlan usual;
  static const std::vector<config::Key> keys{
      NumberKey("offset_s", {0.0, 600.0}, usual.offset_s, "When the first phase begins."),
      NumberKey("amber_s", {1.0, 10.0}, usual.amber_s, "Amber after green."),
      NumberKey("all_red_s", {0.0, 60.0}, usual.all_red_s, "Red for all after amber."),
      NumberKey("red_amber_s", {0.0, 10.0}, usual.red_amber_s, "Red and amber before green, within the two above."),
      Required(config::Counted(
          1, std::numeric_limits<std::size_t>::max(),
          config::ListKey(
              "phases",
              {Required(config::ListKey("green", config::TextItem("main"), "What is green.")),
               config::WithSample("20", config::RequiredNumberKey("for_s", {1.0, 600.0}, "Length of the phase."))},
              "Phases, one after the other.")))};
  return keys;
}

}  // namespace rodeira::lights

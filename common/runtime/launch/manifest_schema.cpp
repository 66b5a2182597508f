// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/manifest_schema.hpp"

namespace rodeira::launch {

const config::Schema& ManifestSchema() {
  using config::ComputedTextKey;
  static const config::Schema schema{
      "node", "node/1", "The manifest of a node outside Rodeira: its rate and its samples.",
      config::FileKeys(
          "node/1",
          {config::RequiredNumberKey("period_s", config::Range::Positive(), "Period, unless the launch file has one."),
           config::WithDefaultNote("the period",
                                   config::OptionalNumberKey("delay_s", config::Range::Positive(), "Delay, likewise.")),
           config::FlagKey("can_save", true, "Whether the node has `Save` and `Restore`."),
           config::ListKey("outputs",
                           {config::RequiredTextKey("topic", "rodeira/controls", "Topic that the node publishes."),
                            ComputedTextKey("type", "required for an own topic", "\"lab::Gaze\"", "Type in the IDL."),
                            ComputedTextKey("idl", "required for an own topic", "gaze.idl", "File with the type.")},
                           "Topics that the node publishes."),
           config::ListKey("inputs",
                           {config::RequiredTextKey("topic", "rodeira/vehicle_state", "Topic that the node reads."),
                            config::Required(config::WordKey("port", {"state", "event"}, "state",
                                                             "`state`: the newest sample; `event`: all.")),
                            config::FlagKey("many", false, "Any number of sources."),
                            config::FlagKey("required", true, "Refused without a source.")},
                           "Topics that the node reads.")})};
  return schema;
}

}  // namespace rodeira::launch

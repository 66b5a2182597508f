// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/launch_schema.hpp"

#include "common/runtime/launch/discovery.hpp"
#include "common/runtime/launch/kinds.hpp"
#include "common/runtime/launch/transport.hpp"

namespace rodeira::launch {
namespace {

using config::ComputedNumberKey;
using config::ComputedTextKey;
using config::MappingKey;
using config::NumberKey;
using config::WithDefaultNote;
using config::WordKey;

const std::vector<std::string> kPolicies{"stop", "pause", "restart"};

config::Key KindKey() {
  std::vector<std::string> kinds = KindNames();
  const std::string first = kinds.front();
  config::Key key = config::Summarised(
      "those below", WordKey("kind", std::move(kinds), first, "Kind of the node; `none` leaves it out."));
  key = config::Required(std::move(key));
  key.sample = "empty";
  return key;
}

config::Key InputsKey() {
  const std::string meaning = "Sources of a topic; by default every other node that publishes it.";
  config::Key key = config::NamedValueKey("inputs", config::ListKey("", config::TextItem(""), meaning), meaning);
  key.sample = "pulse";
  return key;
}

config::Key OutputsKey() {
  config::Key key =
      config::ListKey("outputs", config::TextItem("joint_forces"), "Topics that the node publishes only on request.");
  key.sample = "[]";
  return key;
}

// From `low` on, without an upper bound.
config::Key OpenInteger(config::Key key) {
  key.range.high = config::Range{}.high;
  return key;
}

config::Schema MakeLaunchSchema() {
  std::vector<config::Key> keys{
      ComputedTextKey("name", "file name", "drive", "Name of the run."),
      ComputedTextKey("world", "none", "plane.yaml", "World file, .xodr or .motors."),
      ComputedTextKey("lab", "none", "lab.yaml", "Laboratory file."),
      MappingKey("vehicle",
                 {ComputedTextKey("model", "the files' own", "ode", "Takes the file of this model for each car.")},
                 "Cars."),
      OpenInteger(config::IntegerKey("seed", 0, 1, 1, "Random seed.")),
      WithDefaultNote("no end", config::OptionalNumberKey("duration_s", config::Range::Positive(), "Simulated time.")),
      ComputedTextKey("pace", "max", "real", "`max`, `real` or a factor."),
      NumberKey("base_step_s", {1e-6, 1.0}, 0.001, "The base step."),
      config::IntegerKey("window_steps", 1, 1'000'000, 100, "How far the clock grants beyond the slowest node."),
      NumberKey("snapshot_every_s", config::Range::Positive(), 1.0, "Interval of recorded snapshots."),
      WordKey("recovery", kPolicies, "stop", "What follows if a node is lost."),
      WithDefaultNote("shared_memory", config::OtherKey("transport", "shared_memory, udp, or a mapping", "udp",
                                                        "How samples reach other processes.", TransportKeys())),
      MappingKey("discovery", DiscoveryKeys(), "How processes find each other; needs `transport: udp`."),
      MappingKey(
          "limits",
          {NumberKey("silence_s", {0.1, 3600.0}, 0.6, "Silence after which a node is lost."),
           NumberKey("step_s", {0.01, 86400.0}, 0.6, "Deadline of one step."),
           NumberKey("start_s", {0.1, 86400.0}, 60.0, "Until all nodes are ready, and for their output at the end.")},
          "Limits in wall time."),
      config::Required(config::NamedKey("nodes", NodeKeys(), "The nodes."))};
  return {"launch", "launch/1", "The nodes of a run, its world, rates and transport.",
          config::FileKeys("launch/1", std::move(keys))};
}

}  // namespace

const std::vector<config::Key>& TransportKeys() {
  static const std::vector<config::Key> keys{
      WordKey("kind", {"shared_memory", "udp"}, "shared_memory", "`udp`: between PCs."),
      WordKey("observers", {"none", "udp"}, "none", "`udp`: samples also reach other programs."),
      config::IntegerKey("segment_kib", TransportSettings::kMinSegmentKib, std::int64_t{1} << 20,
                         TransportSettings::kSegmentKib, "Most shared memory of a process; not with `udp`.")};
  return keys;
}

const std::vector<config::Key>& DiscoveryKeys() {
  static const std::vector<config::Key> keys{
      WordKey("kind", {"multicast", "peers", "server"}, "multicast", "`server`: the clock's process on one PC."),
      ComputedTextKey("interface", "any", "192.168.10.1", "Address of the PC in its network."),
      WithDefaultNote("required for `peers`",
                      config::ListKey("addresses", config::TextItem("192.168.10.1"), "Address of each PC.")),
      config::IntegerKey("participants", 1, 119, Discovery().participants, "Most processes on a PC; only for `peers`."),
      ComputedTextKey("address", "required for `server`", "192.168.10.1", "Address of the clock's PC."),
      config::IntegerKey("port", 1, 65535, Discovery::kServerPort, "Port; only for `server`.")};
  return keys;
}

const std::vector<config::Key>& NodeKeys() {
  static const std::vector<config::Key> keys{
      KindKey(),
      WithDefaultNote("by `kind`", config::OtherKey("config", "by `kind`", "{}", "What the node itself reads.")),
      ComputedNumberKey("period_s", config::Range::Positive(), "by `kind`", "A multiple of the base step."),
      ComputedNumberKey("delay_s", config::Range::Positive(), "the period", "A multiple of the period."),
      ComputedNumberKey("deadline_s", {0.0, 86400.0}, "`limits.step_s`", "Deadline of one step."),
      WithDefaultNote("that of the run",
                      config::OptionalWordKey("recovery", kPolicies, "What follows if this node is lost.")),
      ComputedTextKey("host", "the clock's", "a", "Host of a laboratory."),
      ComputedTextKey("process", "its own", "cars", "Nodes of one host and one `process` share a process."),
      InputsKey(),
      OutputsKey(),
      ComputedTextKey("program", "required for `external`", "", "Program of a node of kind `external`."),
      ComputedTextKey("manifest", "required for `external`", "", "Its manifest, NAME.yaml."),
      ComputedTextKey("library", "none", "", "Its shared object, for shared processes.")};
  return keys;
}

const config::Schema& LaunchSchema() {
  static const config::Schema schema = MakeLaunchSchema();
  return schema;
}

}  // namespace rodeira::launch

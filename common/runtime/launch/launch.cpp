// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/launch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/core/base/assert.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/runtime/launch/launch_schema.hpp"
#include "common/runtime/launch/manifest.hpp"
#include "common/runtime/launch/override_nodes.hpp"
#include "common/runtime/launch/pace.hpp"
#include "common/runtime/launch/shared_process.hpp"

namespace rodeira::launch {
namespace {

using lockstep::NodeSpec;
using lockstep::PortSpec;
using lockstep::Step;

constexpr std::string_view kTopicPrefix = "rodeira/";

// A launch file names Rodeira's topics without their prefix, all others by their whole name.
std::string ShortName(std::string_view topic) {
  return std::string(topic.starts_with(kTopicPrefix) ? topic.substr(kTopicPrefix.size()) : topic);
}

// Seconds to whole steps; a period that is none is a problem of the file.
Step ToSteps(const config::Map& map, std::string_view key, double seconds, std::int64_t base_step_ns) {
  const double steps = seconds * 1e9 / static_cast<double>(base_step_ns);
  const double whole = std::round(steps);
  if (std::fabs(steps - whole) > 1e-6 * std::max(1.0, steps) || whole < 1.0) {
    map.Problem(key, "config.out_of_range",
                fmt::format("'{}' is {} s; a multiple of the base step ({} s) was expected", key, seconds,
                            static_cast<double>(base_step_ns) * 1e-9));
    return 1;
  }
  return static_cast<Step>(whole);
}

// Topics under `outputs`: those that a node of this kind publishes only where they are named.
std::vector<std::string> ReadRequestedOutputs(const config::DeclaredMap& declared, const NodeKind& kind) {
  std::vector<std::string> names;
  for (const std::string& topic : kind.requested_outputs) names.push_back(ShortName(topic));
  std::vector<std::string> topics;
  const config::List outputs = declared.MapWith("outputs").OptionalItems("outputs");
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string name = outputs.Text(i);
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      outputs.Problem(i, "launch.unknown_output",
                      names.empty() ? fmt::format("'{}' was found; a node of kind '{}' publishes nothing on request",
                                                  name, kind.name)
                                    : fmt::format("'{}' was found; {} was expected{}", name, fmt::join(names, ", "),
                                                  base::DidYouMean(name, names)));
      continue;
    }
    const std::string& topic = kind.requested_outputs[static_cast<std::size_t>(found - names.begin())];
    if (std::ranges::find(topics, topic) == topics.end()) topics.push_back(topic);
  }
  return topics;
}

NodeSpec ReadNode(const config::DeclaredMap& declared, const std::string& name, const NodeKind& kind,
                  std::int64_t base_step_ns) {
  const config::Map& map = declared.map();
  NodeSpec spec;
  spec.name = name;
  spec.kind = kind.name;
  spec.role = kind.role;
  spec.deadline_ms = static_cast<std::int64_t>(declared.Number("deadline_s", 0.0) * 1e3);
  if (kind.role == lockstep::Role::kService) return spec;
  spec.period = ToSteps(map, "period_s", declared.Number("period_s", kind.default_period_s), base_step_ns);
  if (map.Has("delay_s") || kind.default_delay_s) {
    const double delay_s = declared.Number("delay_s", kind.default_delay_s.value_or(1.0));
    spec.delay = ToSteps(map, "delay_s", delay_s, base_step_ns);
  }
  spec.outputs = kind.outputs;
  for (const std::string& topic : ReadRequestedOutputs(declared, kind)) spec.outputs.push_back(topic);
  return spec;
}

// The kind of a node that stands in `map`; of an external node it is made from the manifest.
base::Result<std::shared_ptr<const NodeKind>> ReadKind(const config::DeclaredMap& declared,
                                                       std::vector<Manifest>& manifests, idl::TopicTable& topics) {
  const std::string name = declared.Word("kind");
  if (name != kExternalKind) {
    const NodeKind* known = FindKind(name);
    RODEIRA_ASSERT(known != nullptr);  // a problem gives the first one
    return std::shared_ptr<const NodeKind>(std::shared_ptr<void>(), known);
  }
  const config::Map& map = declared.map();
  const std::filesystem::path program = declared.MapWith("program").Path("program");
  const std::filesystem::path path = declared.MapWith("manifest").Path("manifest");
  const bool is_yaml = path.extension() == ".yaml" || path.extension() == ".yml";
  if (!path.empty() && !is_yaml)
    map.Problem("manifest", fmt::format("'{}' was found; a file NAME.yaml was expected", path.string()));
  if (program.empty() || !is_yaml) {  // a problem of the launch file, which is said later
    NodeKind unknown;
    unknown.name = name;
    unknown.default_period_s = 1.0;
    return std::make_shared<const NodeKind>(std::move(unknown));
  }
  auto manifest = ReadManifest(path);
  if (!manifest) return manifest.error();
  for (std::size_t i = 0; i < manifest.value().topics.size(); ++i) {
    if (auto status = topics.Add(manifest.value().topics[i]); !status)
      return status.error().WithContext(manifest.value().topic_places[i]);
  }
  manifest.value().kind.program = std::filesystem::absolute(program).lexically_normal().string();
  if (const auto library = declared.MapWith("library").OptionalPath("library"))
    manifest.value().kind.library = std::filesystem::absolute(*library).lexically_normal().string();
  manifests.push_back(std::move(manifest).value());
  return std::make_shared<const NodeKind>(manifests.back().kind);
}

// Recorders take every topic that manifests add.
void AddToRecorders(const idl::TopicTable& topics, std::vector<LaunchNode>& nodes) {
  if (topics.added().empty()) return;
  for (LaunchNode& node : nodes) {
    if (node.kind->name != "recorder") continue;
    NodeKind kind = *node.kind;
    for (const idl::AddedTopic& added : topics.added())
      kind.inputs.push_back({added.topic, lockstep::PortKind::kEvent, true, false});
    node.kind = std::make_shared<const NodeKind>(std::move(kind));
  }
}

// Where there is a recorder, all others but sinks publish their state, at the same steps: each `snapshot_every_s`,
// rounded up to a common multiple of their periods.
void SetSnapshots(const config::DeclaredMap& declared, std::int64_t base_step_ns, std::vector<NodeSpec>& specs) {
  Step every = ToSteps(declared.map(), "snapshot_every_s", declared.Number("snapshot_every_s"), base_step_ns);
  const auto has_state = [](const NodeSpec& spec) {
    return spec.role == lockstep::Role::kStepped && !spec.outputs.empty();
  };
  if (std::none_of(specs.begin(), specs.end(), [](const NodeSpec& spec) { return spec.kind == "recorder"; })) return;
  Step common = 1;
  for (const NodeSpec& spec : specs) {
    // Recorders too: one that begins at a snapshot waits for none that lies before.
    if (has_state(spec) || spec.kind == "recorder") common = std::lcm(common, spec.period);
  }
  every = lockstep::CeilTo(every, common);
  for (NodeSpec& spec : specs) {
    if (has_state(spec)) spec.snapshot_every = every;
  }
}

// Names of the other nodes that publish a topic.
std::vector<std::string> Publishers(const std::vector<NodeSpec>& specs, std::string_view topic,
                                    const std::string& except) {
  std::vector<std::string> names;
  for (const NodeSpec& spec : specs) {
    if (spec.name == except) continue;
    if (topic == lockstep::kSnapshotTopic && spec.snapshot_every > 0) names.push_back(spec.name);
    for (const std::string& output : spec.outputs) {
      if (output == topic) names.push_back(spec.name);
    }
  }
  return names;
}

// Wires a node's inputs: as `inputs` says, otherwise to every other node that publishes the topic.
void Wire(const config::DeclaredMap& declared, const NodeKind& kind, const std::vector<NodeSpec>& specs,
          NodeSpec& spec) {
  const config::Map& map = declared.map();
  const config::Map inputs = declared.MapWith("inputs").OptionalChild("inputs");
  for (const KindPort& port : kind.inputs) {
    const std::string key = ShortName(port.topic);
    PortSpec out{std::string(port.topic), port.kind, {}};
    if (inputs.Has(key)) {
      const config::List names = inputs.OptionalItems(key);
      for (std::size_t i = 0; i < names.size(); ++i) out.sources.push_back(names.Text(i));
    } else {
      out.sources = Publishers(specs, port.topic, spec.name);
      if (!port.many && out.sources.size() > 1) {
        map.Problem("kind", "launch.not_wired",
                    fmt::format("node '{}' takes '{}' from one node, but {} publish it ({}); say which under 'inputs'",
                                spec.name, key, out.sources.size(), fmt::join(out.sources, ", ")));
      }
    }
    if (!port.many && out.sources.size() > 1) out.sources.resize(1);
    if (port.required && out.sources.empty()) {
      map.Problem("kind", "launch.not_wired",
                  fmt::format("node '{}' needs '{}', but no node publishes it", spec.name, key));
    }
    if (!out.sources.empty()) spec.inputs.push_back(std::move(out));
  }
}

// "stop" if the key is absent.
lockstep::Policy ReadPolicy(const config::DeclaredMap& declared) {
  const std::vector<std::string> words{"stop", "pause", "restart"};
  const std::string word = declared.MapWith("recovery").Choice("recovery", words, "stop");
  return word == "restart" ? lockstep::Policy::kRestart
         : word == "pause" ? lockstep::Policy::kPause
                           : lockstep::Policy::kStop;
}

// A person's input cannot be computed again.
void ExceptLiveInput(const std::vector<config::Map>& maps, std::vector<LaunchNode>& nodes) {
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].recovery != lockstep::Policy::kRestart || !nodes[n].is_live()) continue;
    nodes[n].recovery = lockstep::Policy::kStop;
    if (!maps[n].Has("recovery")) continue;
    maps[n].Problem(
        "recovery",
        fmt::format("node '{}' is driven by a person, whose input cannot be computed again; stop or pause was expected",
                    nodes[n].name));
  }
}

}  // namespace

bool LaunchNode::is_live() const {
  if (kind->name == "scenario") return takes_requests();
  static const std::vector<std::string> kLive{"keyboard", "joystick", "gamepad", "agent"};
  const auto source = config->Peek({"config", "source"});
  return kind->name == "input" && source && std::ranges::find(kLive, *source) != kLive.end();
}

bool LaunchNode::takes_requests() const {
  return kind->name == "scenario" && config->Peek({"config", "requests"}) == "true";
}

std::vector<lockstep::Policy> Launch::policies() const {
  std::vector<lockstep::Policy> policies;
  for (const LaunchNode& node : nodes_) policies.push_back(node.recovery);
  return policies;
}

base::Status Launch::CheckRecovery() const {
  const auto& nodes = roster_->nodes();
  if (std::any_of(nodes.begin(), nodes.end(), [](const lockstep::RosterNode& node) { return node.keeps_snapshots(); }))
    return {};
  for (const LaunchNode& node : nodes_) {
    if (node.recovery != lockstep::Policy::kRestart || node.kind->outputs.empty()) continue;
    return base::WrongInput("launch.no_recorder",
                            fmt::format("node '{}' can be started again only where there is a recorder, but there is "
                                        "none (with --no-record: --set recovery=stop)",
                                        node.name),
                            path().string());
  }
  return {};
}

bool Launch::keeps_for_restarts() const { return lockstep::Recovery(*roster_, policies()).restarts(); }

base::Result<Launch> Launch::Load(const std::filesystem::path& path, const Overrides& overrides) {
  auto file = config::File::Load(path);
  if (!file) return file.error();
  return Read(std::move(file).value(), overrides);
}

base::Result<Launch> Launch::Parse(std::string_view text, const std::filesystem::path& name,
                                   const Overrides& overrides) {
  auto file = config::File::Parse(text, name);
  if (!file) return file.error();
  return Read(std::move(file).value(), overrides);
}

base::Result<Launch> Launch::Read(config::File file, const Overrides& overrides) {
  for (const auto& [key, value] : overrides) {
    if (auto status = file.Override(key, value); !status) return status.error();
  }
  Launch launch;
  launch.overrides_ = overrides;
  launch.file_ = std::make_shared<config::File>(std::move(file));
  const config::Map root = launch.file_->root();
  const config::DeclaredMap declared(root, LaunchSchema().keys);
  (void)declared.Word("rodeira");
  launch.name_ = declared.Text("name", launch.file_->path().stem().string());
  if (const auto world = declared.MapWith("world").OptionalPath("world")) launch.world_ = *world;
  if (const auto lab = declared.MapWith("lab").OptionalPath("lab")) launch.lab_ = *lab;
  launch.vehicle_model_ = declared.Child("vehicle").Text("model", "");
  launch.seed_ = static_cast<std::uint64_t>(declared.MapWith("seed").Integer("seed", 0, INT64_MAX, 1));
  launch.duration_s_ = declared.OptionalNumber("duration_s");
  launch.transport_ = ReadTransport(declared.MapWith("transport"));
  launch.discovery_ = ReadDiscovery(declared.MapWith("discovery").OptionalChild("discovery"));
  if (launch.discovery_.kind != DiscoveryKind::kMulticast && launch.transport() != Transport::kUdp) {
    root.Problem("discovery", "config.conflicting_keys",
                 fmt::format("'discovery.kind' is '{}', which needs 'transport: udp'", Word(launch.discovery_.kind)));
  }
  launch.pace_ = declared.Text("pace", "");
  if (root.Has("pace") && !ParsePace(launch.pace_).ok()) {
    root.Problem("pace", fmt::format("'pace' is '{}'; max, real or a positive number was expected", launch.pace_));
  }
  const double base_step_s = declared.Number("base_step_s");
  const auto base_step_ns = static_cast<std::int64_t>(std::llround(base_step_s * 1e9));
  const Step window = declared.Integer("window_steps");
  const config::DeclaredMap limits = declared.Child("limits");
  launch.watchdog_.silence_ms = static_cast<std::int64_t>(limits.Number("silence_s") * 1e3);
  launch.watchdog_.deadline_ms = static_cast<std::int64_t>(limits.Number("step_s") * 1e3);
  launch.watchdog_.start_ms = static_cast<std::int64_t>(limits.Number("start_s") * 1e3);

  launch.recovery_ = ReadPolicy(declared);
  const config::Map nodes = declared.MapWith("nodes").Child("nodes");
  if (auto status = CheckNodesOf(overrides, nodes); !status) return status.error();
  std::vector<NodeSpec> specs;
  std::vector<config::Map> maps;
  std::vector<Manifest> manifests;
  for (const std::string& name : nodes.Keys()) {
    if (nodes.Peek({name, "kind"}) == kNoKind) continue;  // as if it were not there, with all that stands under it
    const config::Map map = nodes.OptionalChild(name);
    const config::DeclaredMap node_keys(map, NodeKeys());
    const auto kind = ReadKind(node_keys, manifests, launch.topics_);
    if (!kind) return kind.error();
    LaunchNode node{name, kind.value(), node_keys.Text("host", ""), std::make_shared<const config::Map>(map),
                    launch.recovery_};
    if (map.Has("recovery")) node.recovery = ReadPolicy(node_keys);
    node.process = node_keys.Text("process", "");
    node_keys.MapWith("config").IgnoreKey("config");
    specs.push_back(ReadNode(node_keys, name, *kind.value(), base_step_ns));
    launch.nodes_.push_back(std::move(node));
    maps.push_back(map);
  }
  AddToRecorders(launch.topics_, launch.nodes_);
  SetSnapshots(declared, base_step_ns, specs);
  ExceptLiveInput(maps, launch.nodes_);
  SettleProcesses(maps, launch.nodes_);
  for (const Manifest& manifest : manifests) {
    const base::Status inputs = CheckInputs(manifest, launch.topics_);
    if (inputs.ok()) continue;
    // What is wrong with the launch file itself comes first: it may be the cause.
    for (const config::Map& map : maps) map.IgnoreKey("inputs");
    if (auto status = launch.file_->Finish(); !status) return status.error();
    return inputs.error();
  }
  for (std::size_t n = 0; n < specs.size(); ++n) Wire({maps[n], NodeKeys()}, *launch.nodes_[n].kind, specs, specs[n]);
  if (auto status = launch.file_->Finish(); !status) return status.error();
  if (specs.empty())
    return base::WrongInput("launch.no_nodes", "'nodes' is empty; at least one node was expected", nodes.Place());
  auto roster = lockstep::Roster::Create(base_step_ns, window, specs);
  if (!roster) return roster.error().In(launch.path().string());
  launch.roster_ = std::make_shared<const lockstep::Roster>(std::move(roster).value());
  return launch;
}

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/roster.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/bytes.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::lockstep {
namespace {

base::Status CheckNode(const NodeSpec& spec) {
  const std::string where = fmt::format("node '{}'", spec.name);
  if (spec.name.empty()) return base::WrongInput("launch.node_without_name", "a node has no name");
  if (spec.role == Role::kService && (!spec.outputs.empty() || !spec.inputs.empty())) {
    return base::WrongInput("launch.wrong_wire", "a service has neither inputs nor outputs in the lockstep", where);
  }
  if (spec.period < 1)
    return base::WrongInput("launch.wrong_period",
                            fmt::format("period {} was found, at least 1 step was expected", spec.period), where);
  if (spec.delay != 0 && (spec.delay < spec.period || spec.delay % spec.period != 0)) {
    return base::WrongInput(
        "launch.wrong_period",
        fmt::format("delay {} was found, a multiple of the period {} was expected", spec.delay, spec.period), where);
  }
  if (spec.snapshot_every < 0 || spec.snapshot_every % spec.period != 0) {
    return base::WrongInput("launch.wrong_period",
                            fmt::format("snapshots each {} steps were found, a multiple of the period {} was expected",
                                        spec.snapshot_every, spec.period),
                            where);
  }
  return {};
}

base::Digest HashOf(std::int64_t base_step_ns, Step window, const std::vector<RosterNode>& nodes,
                    const std::vector<Source>& sources) {
  base::ByteWriter out;
  out.Put(base_step_ns);
  out.Put(window);
  for (const RosterNode& node : nodes) {
    out.PutString(node.name);
    out.PutString(node.kind);
    out.Put(node.role);
    out.Put(node.period);
    out.Put(node.delay);
    for (const SourceIndex output : node.outputs) out.PutString(sources[output].topic);
    if (node.snapshots) out.Put(sources[*node.snapshots].period);
    for (const Port& port : node.inputs) {
      out.PutString(port.topic);
      out.Put(port.kind);
      for (const SourceIndex source : port.sources) out.Put(source);
    }
  }
  return base::Hash(out.bytes());
}

}  // namespace

base::Result<Roster> Roster::Create(std::int64_t base_step_ns, Step window, const std::vector<NodeSpec>& specs) {
  if (base_step_ns < 1)
    return base::WrongInput("launch.wrong_period",
                            fmt::format("base step {} ns was found, at least 1 ns was expected", base_step_ns));
  if (window < 1)
    return base::WrongInput("launch.wrong_period",
                            fmt::format("window {} was found, at least 1 step was expected", window));
  Roster roster;
  roster.base_step_ns_ = base_step_ns;
  roster.window_ = window;
  for (const NodeSpec& spec : specs) {
    if (auto status = CheckNode(spec); !status) return status.error();
    if (roster.Find(spec.name) != roster.nodes_.size())
      return base::WrongInput("launch.duplicate_node", fmt::format("two nodes are named '{}'", spec.name));
    RosterNode node{spec.name,        spec.kind, spec.role, spec.period, spec.delay == 0 ? spec.period : spec.delay,
                    spec.deadline_ms, {},        {},        {}};
    for (const std::string& topic : spec.outputs) {
      node.outputs.push_back(static_cast<SourceIndex>(roster.sources_.size()));
      roster.sources_.push_back({static_cast<NodeIndex>(roster.nodes_.size()), topic, node.period, node.delay});
    }
    roster.nodes_.push_back(std::move(node));
  }
  // Behind all others, so that the node that keeps snapshots changes no other source's number.
  for (NodeIndex n = 0; n < roster.nodes_.size(); ++n) {
    if (specs[n].snapshot_every == 0) continue;
    roster.nodes_[n].snapshots = static_cast<SourceIndex>(roster.sources_.size());
    roster.sources_.push_back({n, std::string(kSnapshotTopic), specs[n].snapshot_every, specs[n].snapshot_every});
  }
  for (std::size_t n = 0; n < specs.size(); ++n) {
    for (const PortSpec& spec : specs[n].inputs) {
      Port port{spec.topic, spec.kind, {}};
      for (const std::string& name : spec.sources) {
        const NodeIndex from = roster.Find(name);
        const std::string where = fmt::format("node '{}', input '{}'", specs[n].name, spec.topic);
        if (from == roster.nodes_.size()) {
          return base::WrongInput("launch.unknown_node",
                                  fmt::format("there is no node '{}'{}", name, base::DidYouMean(name, roster.Names())),
                                  where);
        }
        if (spec.topic == kSnapshotTopic && roster.nodes_[from].snapshots) {
          if (!roster.nodes_[n].is_sink())
            return base::WrongInput("launch.wrong_wire", "only a sink can be wired to snapshots", where);
          port.sources.push_back(*roster.nodes_[from].snapshots);
          continue;
        }
        const auto& outputs = roster.nodes_[from].outputs;
        const auto found = std::find_if(outputs.begin(), outputs.end(),
                                        [&](SourceIndex s) { return roster.sources_[s].topic == spec.topic; });
        if (found == outputs.end())
          return base::WrongInput("launch.not_published", fmt::format("node '{}' does not publish this topic", name),
                                  where);
        port.sources.push_back(*found);
      }
      std::sort(port.sources.begin(), port.sources.end());
      for (const Port& other : roster.nodes_[n].inputs) {
        if (other.topic == port.topic)
          return base::WrongInput("launch.wrong_wire", "the topic is wired to two inputs",
                                  fmt::format("node '{}', input '{}'", specs[n].name, spec.topic));
      }
      if (std::adjacent_find(port.sources.begin(), port.sources.end()) != port.sources.end()) {
        return base::WrongInput("launch.wrong_wire", "a source is wired twice",
                                fmt::format("node '{}', input '{}'", specs[n].name, spec.topic));
      }
      roster.nodes_[n].inputs.push_back(std::move(port));
    }
  }
  roster.hash_ = HashOf(base_step_ns, window, roster.nodes_, roster.sources_);
  return roster;
}

bool RosterNode::keeps_snapshots() const {
  return is_sink() &&
         std::any_of(inputs.begin(), inputs.end(), [](const Port& port) { return port.topic == kSnapshotTopic; });
}

NodeIndex Roster::Find(std::string_view name) const {
  const auto found =
      std::find_if(nodes_.begin(), nodes_.end(), [&](const RosterNode& node) { return node.name == name; });
  return static_cast<NodeIndex>(found - nodes_.begin());
}

std::vector<std::string> Roster::Names() const {
  std::vector<std::string> names;
  for (const RosterNode& node : nodes_) names.push_back(node.name);
  return names;
}

std::string Roster::SourceName(SourceIndex index) const {
  if (index >= sources_.size()) return fmt::format("source {}", index);
  return nodes_[sources_[index].node].name + "." + sources_[index].topic;
}

Step Roster::OldestNeeded(SourceIndex source, Step step) const {
  Step oldest = FloorTo(step, sources_[source].period);
  for (const RosterNode& node : nodes_) {
    const Step first = CeilTo(step, node.period);
    for (const Port& port : node.inputs) {
      if (!std::binary_search(port.sources.begin(), port.sources.end(), source)) continue;
      if (port.kind == PortKind::kEvent) oldest = std::min(oldest, first - node.period + 1);
    }
  }
  return std::max<Step>(oldest, 0);
}

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/roster.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/core/base/bytes.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::lockstep {
namespace {

base::Status CheckNode(const NodeSpec& wish) {
  const std::string where = fmt::format("node '{}'", wish.name);
  if (wish.name.empty()) return base::WrongInput("a node has no name");
  if (wish.role == Role::kService && (!wish.outputs.empty() || !wish.inputs.empty())) {
    return base::WrongInput("a service has neither inputs nor outputs in the lockstep", where);
  }
  if (wish.period < 1)
    return base::WrongInput(fmt::format("period {} was found, at least 1 step was expected", wish.period), where);
  if (wish.delay != 0 && (wish.delay < wish.period || wish.delay % wish.period != 0)) {
    return base::WrongInput(
        fmt::format("delay {} was found, a multiple of the period {} was expected", wish.delay, wish.period), where);
  }
  if (wish.snapshot_every < 0 || wish.snapshot_every % wish.period != 0) {
    return base::WrongInput(fmt::format("snapshots each {} steps were found, a multiple of the period {} was expected",
                                        wish.snapshot_every, wish.period),
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

base::Result<Roster> Roster::Create(std::int64_t base_step_ns, Step window, const std::vector<NodeSpec>& wishes) {
  if (base_step_ns < 1)
    return base::WrongInput(fmt::format("base step {} ns was found, at least 1 ns was expected", base_step_ns));
  if (window < 1) return base::WrongInput(fmt::format("window {} was found, at least 1 step was expected", window));
  Roster roster;
  roster.base_step_ns_ = base_step_ns;
  roster.window_ = window;
  for (const NodeSpec& wish : wishes) {
    if (auto status = CheckNode(wish); !status) return status.error();
    if (roster.Find(wish.name) != roster.nodes_.size())
      return base::WrongInput(fmt::format("two nodes are named '{}'", wish.name));
    RosterNode node{wish.name,        wish.kind, wish.role, wish.period, wish.delay == 0 ? wish.period : wish.delay,
                    wish.deadline_ms, {},        {},        {}};
    for (const std::string& topic : wish.outputs) {
      node.outputs.push_back(static_cast<SourceIndex>(roster.sources_.size()));
      roster.sources_.push_back({static_cast<NodeIndex>(roster.nodes_.size()), topic, node.period, node.delay});
    }
    roster.nodes_.push_back(std::move(node));
  }
  // Behind all others, so that who keeps snapshots changes no other source's number.
  for (NodeIndex n = 0; n < roster.nodes_.size(); ++n) {
    if (wishes[n].snapshot_every == 0) continue;
    roster.nodes_[n].snapshots = static_cast<SourceIndex>(roster.sources_.size());
    roster.sources_.push_back({n, std::string(kSnapshotTopic), wishes[n].snapshot_every, wishes[n].snapshot_every});
  }
  for (std::size_t n = 0; n < wishes.size(); ++n) {
    for (const PortSpec& wish : wishes[n].inputs) {
      Port port{wish.topic, wish.kind, {}};
      for (const std::string& name : wish.sources) {
        const NodeIndex from = roster.Find(name);
        const std::string where = fmt::format("node '{}', input '{}'", wishes[n].name, wish.topic);
        if (from == roster.nodes_.size()) {
          return base::WrongInput(fmt::format("there is no node '{}'{}", name, base::DidYouMean(name, roster.Names())),
                                  where);
        }
        if (wish.topic == kSnapshotTopic && roster.nodes_[from].snapshots) {
          if (!roster.nodes_[n].is_sink()) return base::WrongInput("only a sink can be wired to snapshots", where);
          port.sources.push_back(*roster.nodes_[from].snapshots);
          continue;
        }
        const auto& outputs = roster.nodes_[from].outputs;
        const auto found = std::find_if(outputs.begin(), outputs.end(),
                                        [&](SourceIndex s) { return roster.sources_[s].topic == wish.topic; });
        if (found == outputs.end())
          return base::WrongInput(fmt::format("node '{}' does not publish this topic", name), where);
        port.sources.push_back(*found);
      }
      std::sort(port.sources.begin(), port.sources.end());
      for (const Port& other : roster.nodes_[n].inputs) {
        if (other.topic == port.topic)
          return base::WrongInput("the topic is wired to two inputs",
                                  fmt::format("node '{}', input '{}'", wishes[n].name, wish.topic));
      }
      if (std::adjacent_find(port.sources.begin(), port.sources.end()) != port.sources.end()) {
        return base::WrongInput("a source is wired twice",
                                fmt::format("node '{}', input '{}'", wishes[n].name, wish.topic));
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::lockstep {

using NodeIndex = std::uint32_t;
using SourceIndex = std::uint32_t;

enum class Role : std::uint32_t {
  kStepped = 0,  // has activations; a stepped node without outputs is a sink
  kService = 1,  // answers questions (SUELO) and waits for nobody; has no activations
};

enum class PortKind : std::uint32_t {
  kState = 0,  // at activation k, from each source: the sample with v = P_source * floor(k / P_source)
  kEvent = 1,  // at activation k, from each source: all samples valid in (k - P, k], ordered by step, then source
};

// The topic on which a runner publishes its node's state for sinks that keep it.
inline constexpr std::string_view kSnapshotTopic = "rodeira/snapshot";

// One input of a node: a topic and the nodes that it is wired to.
struct PortSpec {
  std::string topic;
  PortKind kind = PortKind::kState;
  std::vector<std::string> sources;  // names of nodes
};

// A node as the launch file describes it.
struct NodeSpec {
  std::string name;
  std::string kind;
  Role role = Role::kStepped;
  Step period = 1;                   // P, base steps
  Step delay = 0;                    // D, base steps; 0 means P
  std::int64_t deadline_ms = 0;      // longest wall time of one step; 0 means the run's default
  std::vector<std::string> outputs;  // topics
  std::vector<PortSpec> inputs;
  Step snapshot_every = 0;  // a multiple of the period: the node's state is a stream of samples too; 0: it is not
};

// One stream of samples: a node's output on a topic. Its index in the roster is its number on the wire.
struct Source {
  NodeIndex node = 0;
  std::string topic;
  Step period = 1;
  Step delay = 1;
};

struct Port {
  std::string topic;
  PortKind kind = PortKind::kState;
  std::vector<SourceIndex> sources;  // ascending
};

struct RosterNode {
  std::string name;
  std::string kind;
  Role role = Role::kStepped;
  Step period = 1;
  Step delay = 1;
  std::int64_t deadline_ms = 0;
  std::vector<SourceIndex> outputs;
  std::vector<Port> inputs;
  // The node's snapshots (law L3), valid at each multiple of this source's period. They are published by the activation
  // at that very step, before it is done, and therefore only sinks may be wired to them: a sink keeps nobody waiting.
  std::optional<SourceIndex> snapshots;

  bool is_sink() const { return role == Role::kStepped && outputs.empty(); }
  // A sink that is wired to snapshots (a recorder): with what it keeps a lost node goes on.
  bool keeps_snapshots() const;
};

// Who takes part and who is wired to whom; fixed for the run (law L1).
class Roster {
 public:
  // Wrong input: a name twice, a period below one, a delay that is no multiple of the period, a source that does not
  // exist or does not publish the topic.
  static base::Result<Roster> Create(std::int64_t base_step_ns, Step window, const std::vector<NodeSpec>& wishes);

  std::int64_t base_step_ns() const { return base_step_ns_; }
  Step window() const { return window_; }
  const std::vector<RosterNode>& nodes() const { return nodes_; }
  const std::vector<Source>& sources() const { return sources_; }
  const RosterNode& node(NodeIndex index) const { return nodes_[index]; }
  const Source& source(SourceIndex index) const { return sources_[index]; }

  // The index, or nodes().size() where no node has the name.
  NodeIndex Find(std::string_view name) const;
  std::vector<std::string> Names() const;
  // "ego.rodeira/vehicle_state", for messages.
  std::string SourceName(SourceIndex index) const;
  // Of everything above: two processes with equal hashes agree on every wire.
  base::Digest hash() const { return hash_; }

  // The oldest step of `source` that any consumer may still ask for at its first activation at or after `step`.
  Step OldestNeeded(SourceIndex source, Step step) const;

 private:
  std::int64_t base_step_ns_ = 1'000'000;
  Step window_ = 1;
  std::vector<RosterNode> nodes_;
  std::vector<Source> sources_;
  base::Digest hash_ = 0;
};

// The newest step at or before `step` that is a multiple of `period`.
constexpr Step FloorTo(Step step, Step period) { return step - (step % period + period) % period; }
// The first multiple of `period` at or after `step`.
constexpr Step CeilTo(Step step, Step period) { return FloorTo(step + period - 1, period); }

}  // namespace rodeira::lockstep

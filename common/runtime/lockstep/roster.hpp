// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The nodes of a run and their connections.

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

using NodeIndex = std::uint32_t;    ///< index of a node in Roster::nodes
using SourceIndex = std::uint32_t;  ///< index of a source in Roster::sources, its number on the wire

/// What a node does in a run.
enum class Role : std::uint32_t {
  kStepped = 0,  ///< has activations; a stepped node without outputs is a sink
  kService = 1,  ///< answers requests (the ground server), waits for no other node, has no activations
};

/// Which samples a port shows at an activation in step k of a node with period P.
enum class PortKind : std::uint32_t {
  kState = 0,  ///< from each source the sample valid at P_source * floor(k / P_source)
  kEvent = 1,  ///< from each source all samples valid in (k - P, k], ordered by step, then by source
};

/// The topic on which the runner publishes a node's state, for sinks that keep it.
inline constexpr std::string_view kSnapshotTopic = "rodeira/snapshot";

/// One input of a node, as the launch file describes it.
struct PortSpec {
  std::string topic;                 ///< name of the topic
  PortKind kind = PortKind::kState;  ///< which samples the port shows
  std::vector<std::string> sources;  ///< names of the nodes that it is wired to
};

/// A node as the launch file describes it. Periods and delays are in base steps.
struct NodeSpec {
  std::string name;                  ///< name in the launch file
  std::string kind;                  ///< kind in the launch file
  Role role = Role::kStepped;        ///< what it does
  Step period = 1;                   ///< period P
  Step delay = 0;                    ///< delay D; 0 means P
  std::int64_t deadline_ms = 0;      ///< longest wall time of one step; 0 means the run's default
  std::vector<std::string> outputs;  ///< topics that it publishes
  std::vector<PortSpec> inputs;      ///< its ports
  Step snapshot_every = 0;           ///< period of its snapshots, a multiple of `period`; 0: no snapshots
};

/// One stream of samples: a node's output on a topic. Its index in the roster is its number on the wire.
struct Source {
  NodeIndex node = 0;  ///< node that publishes it
  std::string topic;   ///< name of the topic
  Step period = 1;     ///< base steps between two samples
  Step delay = 1;      ///< base steps from an activation to the validity of its sample
};

/// One input of a node in a roster.
struct Port {
  std::string topic;                 ///< name of the topic
  PortKind kind = PortKind::kState;  ///< which samples the port shows
  std::vector<SourceIndex> sources;  ///< sources that it is wired to, ascending
};

/// A node in a roster. Periods and delays are in base steps.
struct RosterNode {
  std::string name;                  ///< name in the launch file
  std::string kind;                  ///< kind in the launch file
  Role role = Role::kStepped;        ///< what it does
  Step period = 1;                   ///< period P
  Step delay = 1;                    ///< delay D, a multiple of P
  std::int64_t deadline_ms = 0;      ///< longest wall time of one step; 0 means the run's default
  std::vector<SourceIndex> outputs;  ///< its sources, without snapshots
  std::vector<Port> inputs;          ///< its ports
  /// The source of the node's snapshots (law L3), valid at each multiple of the source's period. The activation at that
  /// very step publishes them before it is finished, so only sinks may be wired to them: no node waits for a sink.
  std::optional<SourceIndex> snapshots;

  /// Says whether the node is a sink: stepped, without outputs.
  /// @return true for a sink
  bool is_sink() const { return role == Role::kStepped && outputs.empty(); }
  /// Says whether the node is a sink that is wired to snapshots (a recorder). A lost node continues from what it keeps.
  /// @return true for such a sink
  bool keeps_snapshots() const;
};

/// The nodes of a run and their connections, fixed for the run (law L1). Objects do not change after Create.
class Roster {
 public:
  /// Makes a roster from the nodes of a launch file.
  /// @param base_step_ns length of a base step in ns, at least 1
  /// @param window steps that the clock grants ahead of the slowest node, at least 1
  /// @param specs the nodes, in the order of the launch file
  /// @return the roster; wrong input if a name stands twice, a period is below 1, or a delay is no multiple of its
  ///   period. A source that does not exist or does not publish the topic is wrong input, too.
  static base::Result<Roster> Create(std::int64_t base_step_ns, Step window, const std::vector<NodeSpec>& specs);

  /// Gives the length of a base step.
  /// @return nanoseconds
  std::int64_t base_step_ns() const { return base_step_ns_; }
  /// Gives the number of steps that the clock grants ahead of the slowest node.
  /// @return base steps
  Step window() const { return window_; }
  /// Gives all nodes.
  /// @return the nodes in the order of the launch file; a NodeIndex is an index here
  const std::vector<RosterNode>& nodes() const { return nodes_; }
  /// Gives all sources.
  /// @return outputs in the order of nodes, then snapshots; a SourceIndex is an index here
  const std::vector<Source>& sources() const { return sources_; }
  /// Gives a node.
  /// @param index index of the node, less than nodes().size()
  /// @return the node
  const RosterNode& node(NodeIndex index) const { return nodes_[index]; }
  /// Gives a source.
  /// @param index index of the source, less than sources().size()
  /// @return the source
  const Source& source(SourceIndex index) const { return sources_[index]; }

  /// Finds a node by its name.
  /// @param name name in the launch file
  /// @return its index, or nodes().size() if no node has the name
  NodeIndex Find(std::string_view name) const;
  /// Lists the names of all nodes.
  /// @return the names in the order of nodes()
  std::vector<std::string> Names() const;
  /// Names a source, for messages.
  /// @param index index of the source; may be any number
  /// @return "ego.rodeira/vehicle_state"; "source N" if there is no such source
  std::string SourceName(SourceIndex index) const;
  /// Gives the digest of nodes, sources and wiring. Two processes with equal digests agree on every connection.
  /// @return the digest
  base::Digest hash() const { return hash_; }

  /// Finds the oldest sample that a consumer may still need at its first activation at or after a step.
  /// @param source index of the source
  /// @param step the step
  /// @return validity of that sample in base steps, at least 0
  Step OldestNeeded(SourceIndex source, Step step) const;

 private:
  std::int64_t base_step_ns_ = 1'000'000;
  Step window_ = 1;
  std::vector<RosterNode> nodes_;
  std::vector<Source> sources_;
  base::Digest hash_ = 0;
};

/// Rounds a step down to a multiple of a period.
/// @param step the step; may be negative
/// @param period the period, at least 1
/// @return the newest multiple at or before `step`
constexpr Step FloorTo(Step step, Step period) { return step - (step % period + period) % period; }
/// Rounds a step up to a multiple of a period.
/// @param step the step; may be negative
/// @param period the period, at least 1
/// @return the first multiple at or after `step`
constexpr Step CeilTo(Step step, Step period) { return FloorTo(step + period - 1, period); }

}  // namespace rodeira::lockstep

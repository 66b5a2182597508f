// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::launch {

// One input that a kind of node has.
struct KindPort {
  std::string topic;
  lockstep::PortKind kind = lockstep::PortKind::kState;
  bool many = false;      // any number of sources; otherwise exactly one
  bool required = false;  // a launch without a source for it is wrong
};

// What a launch file may name as `kind`, with the ports that every node of the kind has. A node of kind `external` has
// one of its own, made from its manifest.
struct NodeKind {
  std::string name;
  lockstep::Role role = lockstep::Role::kStepped;
  double default_period_s = 0.0;
  std::vector<std::string> outputs;
  std::vector<std::string> requested_outputs = {};  // published only where the launch file names them
  std::vector<KindPort> inputs;
  std::string program;                    // beside `rodeira`; of an external node: its absolute path
  std::string library;                    // of an external node: its shared object, absolute; may be empty
  std::vector<std::string> side_topics;   // outside the lockstep: servers, windows, the run log
  std::optional<double> default_delay_s;  // none: the period
  bool can_save = true;                   // false: its snapshots are without a state (Node::can_save)
};

// A node of this kind is not there: `--set nodes.view.kind=none` leaves it out.
inline constexpr std::string_view kNoKind = "none";

// A node outside Rodeira: the launch file names its program and its manifest.
inline constexpr std::string_view kExternalKind = "external";

// The kinds that Rodeira brings.
const std::vector<NodeKind>& NodeKinds();
// Null where there is no such kind.
const NodeKind* FindKind(std::string_view name);
// What a launch file may name, kExternalKind included.
std::vector<std::string> KindNames();

}  // namespace rodeira::launch

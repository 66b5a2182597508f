// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::launch {

// One input that a kind of node has.
struct KindPort {
  std::string_view topic;
  lockstep::PortKind kind = lockstep::PortKind::kState;
  bool many = false;      // any number of sources; otherwise exactly one
  bool required = false;  // a launch without a source for it is wrong
};

// What a launch file may name as `kind`, with the ports that every node of the kind has.
struct NodeKind {
  std::string_view name;
  lockstep::Role role = lockstep::Role::kStepped;
  double default_period_s = 0.0;
  std::vector<std::string_view> outputs;
  std::vector<KindPort> inputs;
  std::string_view program;                   // the executable beside `rodeira`
  std::vector<std::string_view> side_topics;  // outside the lockstep: servers, windows, the run log
};

// A node of this kind is not there: `--set nodes.view.kind=none` leaves it out.
inline constexpr std::string_view kNoKind = "none";

const std::vector<NodeKind>& NodeKinds();
// Null where there is no such kind.
const NodeKind* FindKind(std::string_view name);
std::vector<std::string> KindNames();

}  // namespace rodeira::launch

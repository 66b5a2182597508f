// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/named_node.hpp"

#include <fmt/format.h>

#include "common/core/base/suggest.hpp"

namespace rodeira::lockstep {

base::Result<NodeIndex> NamedNode(const Roster& roster, const std::string& name) {
  const NodeIndex node = roster.Find(name);
  if (node < roster.nodes().size()) return node;
  return base::WrongInput("launch.unknown_node",
                          fmt::format("there is no node '{}'{}", name, base::DidYouMean(name, roster.Names())),
                          "restart");
}

}  // namespace rodeira::lockstep

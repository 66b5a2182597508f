// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/override_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/suggest.hpp"
#include "common/runtime/launch/launch_schema.hpp"

namespace rodeira::launch {
namespace {

bool IsNodeKey(std::string_view key) {
  return std::ranges::any_of(NodeKeys(), [&](const config::Key& one) { return one.name == key; });
}

}  // namespace

base::Status CheckNodesOf(const Overrides& overrides, const config::Map& nodes) {
  constexpr std::string_view kNodes = "nodes.";
  for (const auto& [key, value] : overrides) {
    if (!key.starts_with(kNodes)) continue;
    const std::size_t dot = key.find('.', kNodes.size());
    if (dot == std::string::npos) continue;  // the whole node
    const std::string name = key.substr(kNodes.size(), dot - kNodes.size());
    const std::string where = fmt::format("--set {}={}", key, value);
    if (!nodes.Peek({name, "kind"})) {
      std::vector<std::string> known = nodes.Keys();
      std::erase_if(known, [&](const std::string& other) { return !nodes.Peek({other, "kind"}); });
      return base::WrongInput("launch.unknown_node",
                              fmt::format("there is no node '{}'{}", name, base::DidYouMean(name, known)), where);
    }
    const std::string below = key.substr(dot + 1);
    if (!IsNodeKey(below.substr(0, below.find('.'))) && nodes.OptionalChild(name).OptionalChild("config").Has(below))
      return base::WrongInput(
          "config.unknown_key",
          fmt::format("unknown key '{}'{}", key, fmt::format("; did you mean 'nodes.{}.config.{}'?", name, below)),
          where);
  }
  return {};
}

}  // namespace rodeira::launch

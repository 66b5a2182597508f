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

// "a, b or c", each in quotes.
std::string Either(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : i + 1 < names.size() ? ", " : " or ", names[i]);
  return text;
}

// A key of a node's own that stands at the top, where the launch file has no such key, or a mapping.
base::Status CheckTopKey(const std::string& key, const std::string& value, const config::Map& nodes) {
  const config::Key* known = config::FindKey(LaunchSchema().keys, key);
  const bool is_mapping = known != nullptr && known->type == config::ValueType::kMapping;
  if (known != nullptr && (!is_mapping || value.find_first_of("{~") != std::string::npos)) return {};
  std::vector<std::string> meant;
  for (const std::string& node : nodes.Keys()) {
    if (nodes.Peek({node, "config", key})) meant.push_back(fmt::format("nodes.{}.config.{}", node, key));
  }
  if (meant.empty()) return {};
  if (is_mapping) {
    for (const config::Key& inner : known->of) meant.push_back(key + "." + inner.name);
  }
  const std::string where = fmt::format("--set {}={}", key, value);
  if (is_mapping)
    return base::WrongInput(
        "config.wrong_type",
        fmt::format("'{}' is '{}'; a mapping was expected; did you mean {}?", key, value, Either(meant)), where);
  return base::WrongInput("config.unknown_key", fmt::format("unknown key '{}'; did you mean {}?", key, Either(meant)),
                          where);
}

}  // namespace

base::Status CheckNodesOf(const Overrides& overrides, const config::Map& nodes) {
  constexpr std::string_view kNodes = "nodes.";
  for (const auto& [key, value] : overrides) {
    if (key.find('.') == std::string::npos) {
      if (auto status = CheckTopKey(key, value, nodes); !status) return status;
    }
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

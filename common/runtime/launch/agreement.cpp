// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/agreement.hpp"

#include <fmt/format.h>

namespace rodeira::launch {

bool IsOfTheRun(const Launch& launch, const std::string& key) {
  for (const std::string_view local : {"transport", "discovery", "limits"}) {
    if (key.starts_with(local) && (key.size() == local.size() || key[local.size()] == '.')) return false;
  }
  for (const LaunchNode& node : launch.nodes()) {
    if (node.kind->name == "recorder" && key == fmt::format("nodes.{}.config.file", node.name)) return false;
  }
  return true;
}

base::Digest Agreement(const Launch& launch) {
  base::Digest digest = base::Combine(launch.roster().hash(), base::Hash(launch.text()));
  for (const auto& [key, value] : launch.overrides()) {
    if (IsOfTheRun(launch, key) && !key.ends_with(".config.window"))
      digest = base::Combine(digest, base::Hash(key + "=" + value));
  }
  return digest;
}

}  // namespace rodeira::launch

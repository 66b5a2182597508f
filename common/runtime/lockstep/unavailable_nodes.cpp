// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/unavailable_nodes.hpp"

#include <fmt/format.h>

namespace rodeira::lockstep {

void UnavailableNodes::Heard(NodeIndex node, std::int64_t now_ns) {
  constexpr std::int64_t kOnItsWayStill_ns = 300'000'000;
  const auto missed = missed_.find(node);
  if (missed != missed_.end() && now_ns - missed->second.since_ns > kOnItsWayStill_ns) missed_.erase(missed);
}

std::string UnavailableNodes::Text(std::int64_t now_ns) const {
  std::string text;
  for (const auto& [node, loss] : missed_) {
    text += fmt::format("{}{} {:.1f} s ago", text.empty() ? "" : "; ", loss.reason,
                        static_cast<double>(now_ns - loss.since_ns) * 1e-9);
  }
  return text;
}

}  // namespace rodeira::lockstep

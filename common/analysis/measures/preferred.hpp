// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace rodeira::measures {

// Of the candidates the one that comes first in `order`; otherwise the first candidate. Nothing where there is none.
template <class Candidates, class TrackOf>
std::optional<std::uint32_t> Preferred(const Candidates& candidates, std::span<const std::uint32_t> order,
                                       const TrackOf& track_of) {
  if (candidates.empty()) return std::nullopt;
  for (const std::uint32_t track : order) {
    for (const auto& candidate : candidates) {
      if (track_of(candidate) == track) return track;
    }
  }
  return track_of(candidates.front());
}

}  // namespace rodeira::measures

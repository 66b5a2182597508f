// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/frame/quality.hpp"

#include <algorithm>
#include <array>

namespace rodeira::nodes {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"low", "medium", "high"};
constexpr std::array<QualityTraits, 3> kTraits = {{
    {0, 1.6F, false, 0, 0.0, 0.0F, 0, 0.0, false, 1.0F, true},
    {4, 1.0F, true, 2048, 110.0, 0.0F, 1024, 3000.0, true, 8.0F, false},
    {4, 1.0F, true, 4096, 200.0, 1.0F, 2048, 4000.0, true, 8.0F, false},
}};

}  // namespace

std::span<const std::string_view> QualityNames() { return kNames; }

std::optional<Quality> QualityOf(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  return found == kNames.end() ? std::nullopt : std::optional(static_cast<Quality>(found - kNames.begin()));
}

const QualityTraits& TraitsOf(Quality quality) { return kTraits[static_cast<std::size_t>(quality)]; }

}  // namespace rodeira::nodes

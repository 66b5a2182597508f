// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace rodeira::base {

// How the name of a field begins that is carried in snapshots and never compared: another program's state,
// which may hold addresses. What it computes is compared: its outputs are fields of their own.
inline constexpr std::string_view kCarried = "carried.";

// Whether two snapshots with names are equal but for the contents of carried fields.
bool SameButCarried(std::span<const std::byte> first, std::span<const std::byte> second);

}  // namespace rodeira::base

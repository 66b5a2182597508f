// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace rodeira::nodes {

// As dashboards show it: R, N, 1, 2, …
inline std::string GearName(std::int32_t gear) { return gear < 0 ? "R" : gear == 0 ? "N" : fmt::format("{}", gear); }

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "common/data/record/mcap_types.hpp"

namespace rodeira::record {

// The whole number that an entry of a metadata record is; none where there is no such entry or it is anything else.
std::optional<std::int64_t> WholeNumber(const TextMap& entries, std::string_view key);

}  // namespace rodeira::record

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::launch {

// How fast a run goes against the clock on the wall: "max" is 0 (as fast as it can), "real" is 1, otherwise a positive
// number. Wrong input with this place otherwise.
base::Result<double> ParsePace(const std::string& text, std::string_view place = "--pace");

}  // namespace rodeira::launch

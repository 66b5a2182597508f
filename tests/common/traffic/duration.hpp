// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "tests/long_form.hpp"

namespace rodeira::traffic {

// Simulated seconds of each run; RODEIRA_TRAFFIC_FOR makes it longer (tests/run --endurance).
inline double Duration(double otherwise_s = BriefOrLong(60.0, 120.0)) {
  const char* text = std::getenv("RODEIRA_TRAFFIC_FOR");
  return text == nullptr ? otherwise_s : std::strtod(text, nullptr);
}

}  // namespace rodeira::traffic

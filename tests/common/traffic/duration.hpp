#pragma once

#include <cstdlib>

namespace rodeira::traffic {

// Simulated seconds of each run; RODEIRA_TRAFFIC_FOR makes it longer (tests/run --endurance).
inline double Duration() {
  const char* text = std::getenv("RODEIRA_TRAFFIC_FOR");
  return text == nullptr ? 120.0 : std::strtod(text, nullptr);
}

}  // namespace rodeira::traffic

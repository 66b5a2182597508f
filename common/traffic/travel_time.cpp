#include "common/traffic/travel_time.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::traffic {
namespace {

constexpr double kLeast_mps = 0.5;

}  // namespace

double TravelTime(double distance_m, double speed_mps, double most_mps, double start_mps2) {
  if (distance_m <= 0.0) return 0.0;
  const double v = speed_mps, top = std::max({most_mps, v, kLeast_mps});
  const double gaining = (top * top - v * v) / (2.0 * start_mps2);
  if (distance_m >= gaining) return (top - v) / start_mps2 + (distance_m - gaining) / top;
  return (std::sqrt(v * v + 2.0 * start_mps2 * distance_m) - v) / start_mps2;
}

}  // namespace rodeira::traffic

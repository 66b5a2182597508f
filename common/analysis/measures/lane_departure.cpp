// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/lane_departure.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

UsedOptions DepartureUsed(const DepartureOptions& options) {
  return Used({{"hysteresis_m", options.hysteresis_m}, {"min_duration_s", options.min_duration_s}});
}

constexpr const char* kNoLine = "no sample has a distance from a line";

}  // namespace

std::vector<Departure> Departures(Series inside_m, double rate_hz, const DepartureOptions& options,
                                  std::span<const std::uint8_t> intended) {
  std::vector<Departure> departures;
  bool out = false;
  Departure now;
  std::size_t last_beyond = 0;
  const auto close = [&] {
    now.to = last_beyond + 1;
    // The end of the last sample's period counts.
    if (static_cast<double>(now.to - now.from) >= options.min_duration_s * rate_hz - 1e-9) departures.push_back(now);
    out = false;
  };
  for (std::size_t i = 0; i < inside_m.size(); ++i) {
    const double d = inside_m[i];
    if (out && (std::isnan(d) || d >= options.hysteresis_m)) close();
    if (std::isnan(d) || d >= 0.0) continue;
    if (!out) {
      out = true;
      now = {};
      now.from = i;
      now.intended = !intended.empty() && intended[i] != 0;
    }
    last_beyond = i;
    now.greatest_m = std::max(now.greatest_m, -d);
    now.area_ms += -d / rate_hz;
  }
  if (out) {
    now.open = true;
    close();
  }
  return departures;
}

Measure DepartureCount(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options) {
  const std::size_t n = CountValid(inside_m);
  if (n == 0) return NotFound(kNoLine, "1", 0, inside_m.size(), DepartureUsed(options));
  return Found(static_cast<double>(departures.size()), "1", n, inside_m.size(), DepartureUsed(options));
}

Measure DepartureShare(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options) {
  const std::size_t n = CountValid(inside_m);
  if (n == 0) return NotFound(kNoLine, "1", 0, inside_m.size(), DepartureUsed(options));
  std::size_t outside = 0;
  for (const Departure& departure : departures) outside += departure.to - departure.from;
  return Found(static_cast<double>(outside) / static_cast<double>(n), "1", n, inside_m.size(), DepartureUsed(options));
}

Measure DepartureArea(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options) {
  const std::size_t n = CountValid(inside_m);
  if (n == 0) return NotFound(kNoLine, "m s", 0, inside_m.size(), DepartureUsed(options));
  double area_ms = 0.0;
  for (const Departure& departure : departures) area_ms += departure.area_ms;
  return Found(area_ms, "m s", n, inside_m.size(), DepartureUsed(options));
}

Measure DepartureGreatest(std::span<const Departure> departures, Series inside_m, const DepartureOptions& options) {
  const std::size_t n = CountValid(inside_m);
  if (departures.empty())
    return NotFound(n == 0 ? kNoLine : "no departure", "m", n, inside_m.size(), DepartureUsed(options));
  double greatest = 0.0;
  for (const Departure& departure : departures) greatest = std::max(greatest, departure.greatest_m);
  return Found(greatest, "m", n, inside_m.size(), DepartureUsed(options));
}

}  // namespace rodeira::measures

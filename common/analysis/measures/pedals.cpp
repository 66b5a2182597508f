// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/pedals.hpp"

#include <algorithm>
#include <cmath>

#include "common/analysis/measures/statistics.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kNoPedal = "no sample of the pedal";

UsedOptions PedalUsed(const PedalOptions& options) { return Used({{"on", options.on}, {"off", options.off}}); }

std::vector<bool> IsPressed(Series pedal, double rate_hz, const PedalOptions& options) {
  std::vector<bool> pressed(pedal.size(), false);
  for (const PedalPress& press : PedalPresses(pedal, rate_hz, options)) {
    for (std::size_t i = press.from; i < press.to; ++i) pressed[i] = true;
  }
  return pressed;
}

}  // namespace

std::vector<PedalPress> PedalPresses(Series pedal, double rate_hz, const PedalOptions& options) {
  std::vector<PedalPress> presses;
  bool pressed = false;
  for (std::size_t i = 0; i < pedal.size(); ++i) {
    const double value = pedal[i];
    pressed = !std::isnan(value) && (pressed ? value >= options.off : value > options.on);
    if (!pressed) continue;
    if (presses.empty() || presses.back().to != i) presses.push_back({i, i, 0.0, 0.0});
    presses.back().to = i + 1;
    presses.back().largest = std::max(presses.back().largest, value);
    presses.back().integral_s += value / rate_hz;
  }
  return presses;
}

Measure PedalPressCount(Series pedal, double rate_hz, const PedalOptions& options) {
  const std::size_t n = CountValid(pedal);
  if (n == 0) return NotFound(kNoPedal, "1", 0, pedal.size(), PedalUsed(options));
  const auto presses = PedalPresses(pedal, rate_hz, options);
  return Found(static_cast<double>(presses.size()), "1", n, pedal.size(), PedalUsed(options));
}

Measure FirstPedalPress(Series pedal, double rate_hz, const PedalOptions& options) {
  const std::size_t n = CountValid(pedal);
  const auto presses = PedalPresses(pedal, rate_hz, options);
  if (presses.empty())
    return NotFound(n == 0 ? kNoPedal : "the pedal is not pressed", "s", n, pedal.size(), PedalUsed(options));
  return Found(static_cast<double>(presses.front().from) / rate_hz, "s", n, pedal.size(), PedalUsed(options));
}

Measure PedalIntegral(Series pedal, double rate_hz, const PedalOptions& options) {
  const std::size_t n = CountValid(pedal);
  if (n == 0) return NotFound(kNoPedal, "s", 0, pedal.size(), PedalUsed(options));
  double integral = 0.0;
  for (const PedalPress& press : PedalPresses(pedal, rate_hz, options)) integral += press.integral_s;
  return Found(integral, "s", n, pedal.size(), PedalUsed(options));
}

Measure BothPedalsShare(Series throttle, Series brake, double rate_hz, const PedalOptions& options) {
  const auto one = IsPressed(throttle, rate_hz, options), other = IsPressed(brake, rate_hz, options);
  std::size_t n = 0, both = 0;
  for (std::size_t i = 0; i < throttle.size(); ++i) {
    if (std::isnan(throttle[i] + brake[i])) continue;
    ++n;
    if (one[i] && other[i]) ++both;
  }
  if (n == 0) return NotFound(kNoPedal, "1", 0, throttle.size(), PedalUsed(options));
  return Found(static_cast<double>(both) / static_cast<double>(n), "1", n, throttle.size(), PedalUsed(options));
}

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/arrivals.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawArrival = 104;
constexpr double kHour_s = 3600.0;

// The time by which so many more are expected, from a time on; beyond the end where there are never so many.
double WhenExpected(const FlowSettings& flow, double count, double from_s) {
  double now = from_s;
  const std::size_t last = flow.per_h.size() - 1;
  for (std::size_t hour = std::min(static_cast<std::size_t>((from_s - flow.from_s) / kHour_s), last); now <= flow.to_s;
       ++hour) {
    const double per_s = flow.per_h[hour] / kHour_s;
    const double end =
        hour == last ? flow.to_s : std::min(flow.to_s, flow.from_s + kHour_s * static_cast<double>(hour + 1));
    if (per_s * (end - now) >= count) return now + count / per_s;
    if (end >= flow.to_s) break;
    count -= per_s * (end - now);
    now = end;
  }
  return flow.to_s + 1.0;
}

}  // namespace

std::int64_t NextArrival_ns(const FlowSettings& flow, std::uint64_t seed, std::uint64_t flow_number,
                            std::uint64_t index, std::int64_t before_ns) {
  const double before_s = std::max(flow.from_s, 1e-9 * static_cast<double>(before_ns));
  const double draw = base::RandomUniform({seed, flow_number, kDrawArrival, index});
  double at_s = 0.0;
  switch (flow.arrivals) {
    case Arrivals::kUniform:
      at_s = before_s + flow.least_gap_s + draw * (flow.most_gap_s - flow.least_gap_s);
      break;
    case Arrivals::kEven:
      at_s = WhenExpected(flow, index == 0 ? 0.5 : 1.0, before_s);
      break;
    case Arrivals::kPoisson:
      at_s = WhenExpected(flow, -std::log1p(-draw), before_s);
      break;
  }
  return at_s > flow.to_s ? -1 : std::llround(1e9 * at_s);
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/lights_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/lanes/lights.hpp"

namespace rodeira::driver {
namespace {

constexpr double kMinGap_m = 0.3;
constexpr double kLeast_mps = 0.01;
constexpr double kStanding_mps = 0.3;
constexpr double kHold_mps2 = -1.0;

}  // namespace

std::vector<LightLine> LightLines(const network::Network& network, const RoutePath& route) {
  std::vector<LightLine> lines;
  for (std::size_t leg = 0; leg < route.legs().size(); ++leg) {
    const RouteLeg& on = route.legs()[leg];
    const network::LaneSection& section = network.Section(on.lane);
    auto lights = lanes::LightsOfLane(network, on.lane, on.along, section.s_m, section.end_s_m);
    if (!on.along) std::reverse(lights.begin(), lights.end());
    for (const lanes::LaneLight& light : lights) lines.push_back({route.Distance(leg, light.s_m), light.controller});
  }
  return lines;
}

std::optional<double> LightStops::Step(const LightSettings& settings, std::span<const LightAhead> lights,
                                       double front_m, double speed_mps, double anticipation_s) {
  const auto next =
      std::find_if(lights.begin(), lights.end(), [&](const LightAhead& light) { return light.d_m >= front_m; });
  if (next == lights.end() || next->colour == network::LightColour::kGreen) {
    decided_m_ = kNone_m;
    return std::nullopt;
  }
  const double v = std::max(0.0, speed_mps);
  const double gap = next->d_m - settings.before_line_m - front_m, then = gap - anticipation_s * v;
  if (decided_m_ != next->d_m) {
    const double most =
        next->colour == network::LightColour::kAmber ? settings.for_amber_mps2 : settings.max_deceleration_mps2;
    decided_m_ = next->d_m;
    passes_ = v > kStanding_mps && v * v > 2.0 * most * std::max(0.0, then);
  }
  if (passes_) return std::nullopt;
  if (gap < kMinGap_m && v < kStanding_mps) return kHold_mps2;
  const double there = std::sqrt(2.0 * settings.braking_mps2 * std::max(0.0, then));
  const double planned = -settings.braking_mps2 * v / std::max(there, kLeast_mps) + (there - v) / settings.tracking_s;
  if (v <= there) return planned;
  return -std::max(v * v / (2.0 * std::max(gap, kMinGap_m)), std::min(settings.braking_mps2, -planned));
}

void LightStops::Save(base::StateWriter& writer) const {
  writer.Put("decided_m", decided_m_);
  writer.Put("passes", passes_);
}

void LightStops::Restore(base::StateReader& reader) {
  reader.Get("decided_m", decided_m_);
  reader.Get("passes", passes_);
}

}  // namespace rodeira::driver

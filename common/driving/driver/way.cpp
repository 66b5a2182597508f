// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/way.hpp"

#include <cmath>

namespace rodeira::driver {

namespace {

LaneSpan SpanAt(const Way::Place& place, const Footprint& footprint) {
  const double turn = footprint.heading_rad - place.heading_rad;
  const double c = std::fabs(std::cos(turn));
  const double s = std::fabs(std::sin(turn));
  const double half_along = 0.5 * (c * footprint.length_m + s * footprint.width_m);
  const double half_across = 0.5 * (s * footprint.length_m + c * footprint.width_m);
  return LaneSpan{place.d_m - half_along, place.d_m + half_along, place.offset_m - half_across,
                  place.offset_m + half_across, footprint.speed_mps * std::cos(turn)};
}

}  // namespace

std::optional<LaneSpan> Way::SpanOf(const Footprint& footprint) const {
  const auto place = Locate(footprint.x_m, footprint.y_m);
  return place ? std::optional(SpanAt(*place, footprint)) : std::nullopt;
}

std::optional<LaneSpan> Way::SpanNear(std::size_t& hint, const Footprint& footprint, const Range& range) const {
  const auto place = Near(hint, footprint.x_m, footprint.y_m, std::nullopt, range);
  return place ? std::optional(SpanAt(*place, footprint)) : std::nullopt;
}

}  // namespace rodeira::driver

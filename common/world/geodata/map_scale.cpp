// SPDX-License-Identifier: Apache-2.0
#include "common/world/geodata/map_scale.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/world/geodata/functions.hpp"

namespace rodeira::terrain::geodata {
namespace {

constexpr double kMaxOff = 0.005;
// WGS 84's ellipsoid (NGA.STND.0036, table 3.1).
constexpr double kEquator_m = 6'378'137.0, kEccentricity2 = 6.694'379'990'14e-3;

// Metres a radian of longitude and of latitude.
std::array<double, 2> MetresARadian(double latitude_rad) {
  const double w2 = 1.0 - kEccentricity2 * std::sin(latitude_rad) * std::sin(latitude_rad);
  return {kEquator_m / std::sqrt(w2) * std::cos(latitude_rad),
          kEquator_m * (1.0 - kEccentricity2) / (w2 * std::sqrt(w2))};
}

}  // namespace

std::optional<MapScale> ScaleAt(const std::string& wkt, double x, double y) {
  const auto map = MakeTransform(wkt);
  if (!map) return std::nullopt;
  const auto middle = map.value()->ToEarth(x, y);
  constexpr double kHalfStep = 50.0;
  const auto metres_between = [&](double dx, double dy) -> std::optional<double> {
    const auto a = map.value()->ToEarth(x - dx, y - dy), b = map.value()->ToEarth(x + dx, y + dy);
    if (!a || !b) return std::nullopt;
    constexpr double kRadian = geometry::kPi / 180.0;
    const auto [across, along] = MetresARadian(middle->latitude_deg * kRadian);
    return std::hypot(across * geometry::WrapAngle((b->longitude_deg - a->longitude_deg) * kRadian),
                      along * (b->latitude_deg - a->latitude_deg) * kRadian);
  };
  if (!middle) return std::nullopt;
  const auto east = metres_between(kHalfStep, 0.0), north = metres_between(0.0, kHalfStep);
  if (!east || !north || !(*east > 0.0) || !(*north > 0.0)) return std::nullopt;
  return MapScale{*middle, 2.0 * kHalfStep / *east, 2.0 * kHalfStep / *north};
}

bool IsOffScale(const MapScale& scale, double metres_a_unit) {
  const auto off = [&](double units_a_m) { return std::fabs(units_a_m * metres_a_unit - 1.0) > kMaxOff; };
  return off(scale.east_units_a_m) || off(scale.north_units_a_m);
}

}  // namespace rodeira::terrain::geodata

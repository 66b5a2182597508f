// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/surface_fade.hpp"

#include <tuple>

namespace rodeira::road {

std::pair<double, double> FadeAt(double distance_m, double over_m) {
  if (distance_m <= 0.0) return {0.0, 0.0};
  if (distance_m >= over_m) return {1.0, 0.0};
  const double u = distance_m / over_m;
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / over_m};
}

Share Share::operator*(const Share& other) const {
  return {value * other.value, by_s * other.value + value * other.by_s, by_t * other.value + value * other.by_t};
}

Share Share::Mixed(const Share& other, double weight, double weight_by_s) const {
  const double rest = 1.0 - weight;
  return {weight * value + rest * other.value, weight * by_s + rest * other.by_s + weight_by_s * (value - other.value),
          weight * by_t + rest * other.by_t};
}

void Raised::Fade(const Share& share) {
  by_s = by_s * share.value + z_m * share.by_s;
  by_t = by_t * share.value + z_m * share.by_t;
  z_m *= share.value;
}

void Raised::Replace(const network::SurfaceSample& sample) {
  z_m -= sample.p_W.z();
  by_s -= sample.ds_W.z();
  by_t -= sample.dt_W.z();
}

RoadEdges::RoadEdges(const network::Road& road, const network::LaneSection& section, double s_m) {
  const geometry::CubicPoint centre = road.CentreAt(s_m);
  const auto edge = [&](double far) {
    double outside;
    const network::LaneSpan span = section.At(far, centre, s_m, outside);
    return std::pair(far + (far > 0.0 ? -outside : outside), span.outer_slope);
  };
  std::tie(left_m, left_slope) = edge(1e4);
  std::tie(right_m, right_slope) = edge(-1e4);
}

Share RoadEdges::FromLeft(double t_m) const {
  const auto [value, slope] = FadeAt(left_m - t_m, kFadesAcross_m);
  return {value, slope * left_slope, -slope};
}

Share RoadEdges::FromRight(double t_m) const {
  const auto [value, slope] = FadeAt(t_m - right_m, kFadesAcross_m);
  return {value, -slope * right_slope, slope};
}

}  // namespace rodeira::road

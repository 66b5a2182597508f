// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/analysis/measures/conflict.hpp"
#include "common/analysis/measures/gap.hpp"
#include "common/analysis/measures/time_to_line.hpp"
#include "common/core/base/suggest.hpp"

namespace rodeira::measures {
namespace {

double TimeGap_s(const Drive& d, std::size_t k) {
  return d.speed_mps[k] >= FollowedOptions{}.min_speed_mps ? d.leader.gap_m[k] / d.speed_mps[k] : kMissing;
}
double Ttc_s(const Drive& d, std::size_t k) {
  return TimeToCollision_s(d.leader.gap_m[k], d.speed_mps[k], d.leader.speed_mps[k]);
}
double Tlc_s(const Drive& d, std::size_t k) {
  return TrigonometricTlc_s({d.lane_position_m[k], d.heading_error_rad[k], d.speed_mps[k], d.yaw_radps[k],
                             d.lane_width_m[k], d.lane_curvature_1pm[k], d.front_m, d.width_m});
}

struct Derived {
  const char* name;
  double (*at)(const Drive& drive, std::size_t k);
};
constexpr std::array kDerived{Derived{"time_gap_s", TimeGap_s}, Derived{"ttc_s", Ttc_s}, Derived{"tlc_s", Tlc_s}};

}  // namespace

const std::vector<std::string>& SeriesNames() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names{"time_s"};
    for (const DriveColumn& column : DriveColumns()) names.emplace_back(column.name);
    for (const Derived& derived : kDerived) names.emplace_back(derived.name);
    return names;
  }();
  return kNames;
}

base::Result<std::size_t> FindSeries(std::string_view name) {
  const auto& names = SeriesNames();
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  return base::WrongInput("measure.unknown_column",
                          fmt::format("there is no column '{}'{}", name, base::DidYouMean(name, names)));
}

double SeriesValue(const Drive& drive, std::size_t column, std::size_t k) {
  if (column == 0) return static_cast<double>(k) / drive.rate_hz;
  const auto columns = DriveColumns();
  if (column <= columns.size()) return columns[column - 1].of(drive)[k];
  return kDerived.at(column - 1 - columns.size()).at(drive, k);
}

std::vector<double> SeriesOf(const Drive& drive, std::size_t column) {
  std::vector<double> values(drive.size());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = SeriesValue(drive, column, k);
  return values;
}

}  // namespace rodeira::measures

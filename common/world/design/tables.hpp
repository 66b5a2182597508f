// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/declared.hpp"
#include "common/core/geometry/cubic.hpp"

// Functions of the station, as cubics.
namespace rodeira::design {

// A value at a station.
struct Knot {
  double s_m = 0.0;
  double value = 0.0;
};

// The same value at every station.
geometry::CubicTable Constant(double value);
// Through the knots, which ascend from 0 on, level at each of them: between two it goes by 3 u^2 - 2 u^3. Before the
// first and behind the last it is constant.
geometry::CubicTable Eased(const std::vector<Knot>& knots);
// first + factor * second.
geometry::CubicTable Sum(const geometry::CubicTable& first, const geometry::CubicTable& second, double factor = 1.0);
// The same function counted from another station: table(s + from_m), as far as it is needed for [0, length].
geometry::CubicTable Part(const geometry::CubicTable& table, double from_m, double length_m);
// The same function but between two stations, where it is the cubic that meets it at both with its values and slopes,
// after these have been moved by `ends`: value, slope at the first, value, slope at the second; NaN: as they are.
struct Hermite {
  double from_s_m, to_s_m;
  double from_value, from_slope, to_value, to_slope;
};
// Outside of [from, to] the table stays as it is.
geometry::CubicTable WithHermite(const geometry::CubicTable& table, const Hermite& piece);

enum class IfAbsent { kProblem, kDefault };
// `key` as one number, or as a list of {s_m, value_key}, ascending. Where both are absent: a problem, or the default of
// `key`.
geometry::CubicTable ReadTable(const config::DeclaredMap& map, std::string_view key, std::string_view list_key,
                               std::string_view value_key, IfAbsent if_absent);
// A list of {s_m, value_key}, ascending.
std::vector<Knot> ReadKnots(const config::DeclaredMap& map, std::string_view list_key, std::string_view value_key);

}  // namespace rodeira::design

// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace rodeira::design {

using geometry::Cubic;
using geometry::CubicTable;

namespace {

// The record in force at x, counted from there.
Cubic Moved(const CubicTable& table, double x) {
  if (table.empty()) return {x, 0.0, 0.0, 0.0, 0.0};
  const Cubic& cubic = table.At(x);
  return {x, cubic.Value(x), cubic.Slope(x), 0.5 * cubic.Bend(x), cubic.d};
}

Cubic Between(double s0, double v0, double g0, double s1, double v1, double g1) {
  const double length = s1 - s0, mean = (v1 - v0) / length;
  return {s0, v0, g0, (3.0 * mean - 2.0 * g0 - g1) / length, (g0 + g1 - 2.0 * mean) / (length * length)};
}

}  // namespace

CubicTable Constant(double value) { return CubicTable({{0.0, value, 0.0, 0.0, 0.0}}); }

CubicTable Eased(const std::vector<Knot>& knots) {
  std::vector<Cubic> records;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (i + 1 < knots.size() && knots[i + 1].value != knots[i].value) {
      records.push_back(Between(knots[i].s_m, knots[i].value, 0.0, knots[i + 1].s_m, knots[i + 1].value, 0.0));
    } else {
      records.push_back({knots[i].s_m, knots[i].value, 0.0, 0.0, 0.0});
    }
  }
  // The first record also holds before its place, where the table is constant.
  if (!records.empty() && records[0].from > 0.0) records.insert(records.begin(), {0.0, records[0].a, 0.0, 0.0, 0.0});
  return CubicTable(std::move(records));
}

CubicTable Sum(const CubicTable& first, const CubicTable& second, double factor) {
  std::set<double> begins;
  for (const CubicTable* table : {&first, &second}) {
    for (const Cubic& cubic : table->records()) begins.insert(cubic.from);
  }
  std::vector<Cubic> records;
  for (const double s : begins) {
    const Cubic a = Moved(first, s), b = Moved(second, s);
    records.push_back({s, a.a + factor * b.a, a.b + factor * b.b, a.c + factor * b.c, a.d + factor * b.d});
  }
  return CubicTable(std::move(records));
}

CubicTable Part(const CubicTable& table, double from_m, double length_m) {
  if (table.empty()) return table;
  std::vector<Cubic> records{Moved(table, from_m)};
  records[0].from = 0.0;
  for (Cubic cubic : table.records()) {
    cubic.from -= from_m;
    if (cubic.from > 0.0 && cubic.from < length_m) records.push_back(cubic);
  }
  return CubicTable(std::move(records));
}

CubicTable WithHermite(const CubicTable& table, const Hermite& piece) {
  std::vector<Cubic> records;
  for (const Cubic& cubic : table.records()) {
    if (cubic.from < piece.from_s_m) records.push_back(cubic);
  }
  records.push_back(
      Between(piece.from_s_m, piece.from_value, piece.from_slope, piece.to_s_m, piece.to_value, piece.to_slope));
  records.push_back(Moved(table, piece.to_s_m));
  for (const Cubic& cubic : table.records()) {
    if (cubic.from > piece.to_s_m) records.push_back(cubic);
  }
  return CubicTable(std::move(records));
}

std::vector<Knot> ReadKnots(const config::DeclaredMap& map, std::string_view list_key, std::string_view value_key) {
  std::vector<Knot> knots;
  const config::DeclaredList list = map.Items(list_key);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const config::DeclaredMap item = list.At(i);
    const Knot knot{item.Number("s_m"), item.Number(value_key)};
    if (!knots.empty() && !(knot.s_m > knots.back().s_m)) {
      item.map().Problem("s_m", "config.wrong_order",
                         fmt::format("the points of '{}' must come in ascending 's_m'", list_key));
      continue;
    }
    knots.push_back(knot);
  }
  return knots;
}

CubicTable ReadTable(const config::DeclaredMap& declared, std::string_view key, std::string_view list_key,
                     std::string_view value_key, IfAbsent if_absent) {
  const config::Map& map = declared.map();
  if (map.Has(list_key)) {
    if (map.Has(key))
      map.Problem(key, "config.conflicting_keys",
                  fmt::format("'{}' and '{}' say the same; one of them was expected", key, list_key));
    const auto knots = ReadKnots(declared, list_key, value_key);
    if (knots.empty())
      map.Problem(list_key, "config.too_few", fmt::format("'{}' has no points; at least one was expected", list_key));
    return Eased(knots);
  }
  return Constant(if_absent == IfAbsent::kDefault ? declared.Number(key) : declared.RequiredNumber(key));
}

}  // namespace rodeira::design

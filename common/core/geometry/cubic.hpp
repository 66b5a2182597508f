// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace rodeira::geometry {

// a + b u + c u^2 + d u^3 with u = x - from, valid from there to the next record.
struct Cubic {
  double from = 0.0;
  double a = 0.0, b = 0.0, c = 0.0, d = 0.0;

  // At x, also beyond the record's end; Slope and Bend: the first and the second derivative.
  double Value(double x) const {
    const double u = x - from;
    return a + u * (b + u * (c + u * d));
  }
  double Slope(double x) const {
    const double u = x - from;
    return b + u * (2.0 * c + u * 3.0 * d);
  }
  double Bend(double x) const { return 2.0 * c + 6.0 * d * (x - from); }
};

// Value of a table at one place. Units follow from those of the value and of the place.
struct CubicPoint {
  double value = 0.0;
  double slope = 0.0;  // first derivative
  double bend = 0.0;   // second derivative
};

// A function made of cubics in ascending order of where they begin; 0 without any. Before the first record the first
// goes on, behind the last the last.
class CubicTable {
 public:
  CubicTable() = default;
  explicit CubicTable(std::vector<Cubic> records);  // in ascending order; of records at the same place the last counts

  bool empty() const { return records_.empty(); }
  bool zero() const;  // every coefficient is 0
  const std::vector<Cubic>& records() const { return records_; }
  // The record in force at x. There must be one.
  const Cubic& At(double x) const { return records_[Index(x)]; }
  // 0 without records. Before the first record that one counts.
  double Value(double x) const { return records_.empty() ? 0.0 : At(x).Value(x); }
  CubicPoint Evaluate(double x) const {
    if (records_.empty()) return {};
    const Cubic& record = At(x);
    return {record.Value(x), record.Slope(x), record.Bend(x)};
  }
  // The smallest and the largest value in [low, high], exact but for rounding.
  void Bounds(double low, double high, double& smallest, double& largest) const;

 private:
  std::size_t Index(double x) const { return records_.size() < 2 || x < records_[1].from ? 0 : IndexBehind(x); }
  std::size_t IndexBehind(double x) const;  // where the first record is not in force
  std::vector<Cubic> records_;
};

}  // namespace rodeira::geometry

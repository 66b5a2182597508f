// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/cubic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"

namespace rodeira::geometry {

CubicTable::CubicTable(std::vector<Cubic> records) : records_(std::move(records)) {
  RODEIRA_ASSERT(
      std::is_sorted(records_.begin(), records_.end(), [](const Cubic& x, const Cubic& y) { return x.from < y.from; }));
}

bool CubicTable::zero() const {
  return std::all_of(records_.begin(), records_.end(),
                     [](const Cubic& r) { return r.a == 0.0 && r.b == 0.0 && r.c == 0.0 && r.d == 0.0; });
}

// The last record that does not begin behind x, by halving; without a branch, which no processor could predict.
std::size_t CubicTable::IndexBehind(double x) const {
  std::size_t first = 1;  // does not begin behind x
  for (std::size_t left = records_.size() - 1; left > 1;) {
    const std::size_t half = left / 2;
    first += half * static_cast<std::size_t>(!(x < records_[first + half].from));
    left -= half;
  }
  return first;
}

void CubicTable::Bounds(double low, double high, double& smallest, double& largest) const {
  smallest = std::numeric_limits<double>::infinity();
  largest = -smallest;
  if (records_.empty()) {
    smallest = largest = 0.0;
    return;
  }
  const auto offer = [&](double value) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  };
  for (std::size_t i = Index(low); i < records_.size() && (i == 0 || records_[i].from <= high); ++i) {
    const Cubic& r = records_[i];
    const double from = i == 0 ? low : std::max(low, r.from);
    const double to = i + 1 < records_.size() ? std::min(high, std::max(from, records_[i + 1].from)) : high;
    offer(r.Value(from));
    offer(r.Value(to));
    // Extremes where b + 2 c u + 3 d u^2 = 0.
    const double root = r.c * r.c - 3.0 * r.b * r.d;
    if (root < 0.0) continue;
    const double q = -(r.c + std::copysign(std::sqrt(root), r.c));
    for (const double u : {r.d != 0.0 ? q / (3.0 * r.d) : r.from, q != 0.0 ? r.b / q : 0.0}) {
      const double x = r.from + u;
      if (x > from && x < to) offer(r.Value(x));
    }
  }
}

}  // namespace rodeira::geometry

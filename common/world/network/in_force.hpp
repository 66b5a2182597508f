// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "common/core/geometry/cubic.hpp"
#include "common/world/network/cluster.hpp"
#include "common/world/network/lean.hpp"

// Parts of Network::QueryBatch.
namespace rodeira::network {

// The smallest and the largest of finite numbers; several at a time, so that none waits for the one before it.
inline void Range(const Cluster::Numbers& numbers, std::size_t count, double& low, double& high) {
  constexpr std::size_t kLanes = 8;
  std::array<double, kLanes> lows, highs;
  lows.fill(numbers[0]), highs.fill(numbers[0]);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      lows[k] = std::min(lows[k], numbers[i + k]);
      highs[k] = std::max(highs[k], numbers[i + k]);
    }
  }
  for (; i < count; ++i) lows[0] = std::min(lows[0], numbers[i]), highs[0] = std::max(highs[0], numbers[i]);
  low = *std::min_element(lows.begin(), lows.end());
  high = *std::max_element(highs.begin(), highs.end());
}

// Whether something holds of every number up to count; not a branch each.
template <class Holds>
bool All(std::size_t count, const Holds& holds) {
  std::int64_t others = 0;
  for (std::size_t i = 0; i < count; ++i) others += holds(i) ? 0 : 1;
  return others == 0;
}

// The record of a table that is in force at all points; null for an empty table.
class InForce {
 public:
  InForce(const geometry::CubicTable& table, const Cluster& cluster) {
    if (table.empty()) return;
    record_ = &table.At(cluster.low_s_m);
    common_ = record_ == &table.At(cluster.high_s_m);
  }
  bool common() const { return common_; }
  const geometry::Cubic& record() const { return record_ == nullptr ? kLevel : *record_; }
  bool constant() const { return record_ == nullptr || (record_->b == 0.0 && record_->c == 0.0 && record_->d == 0.0); }
  // As CubicTable::Evaluate.
  void Evaluate(const Cluster& cluster, Cluster::Numbers& value, Cluster::Numbers& slope) const {
    const std::size_t count = cluster.feet.count;
    if (record_ == nullptr) {
      std::fill_n(value.begin(), count, 0.0);
      std::fill_n(slope.begin(), count, 0.0);
      return;
    }
    const geometry::Cubic cubic = *record_;
    for (std::size_t i = 0; i < count; ++i) {
      value[i] = cubic.Value(cluster.s_m[i]);
      slope[i] = cubic.Slope(cluster.s_m[i]);
    }
  }

 private:
  const geometry::Cubic* record_ = nullptr;
  bool common_ = true;
};

}  // namespace rodeira::network

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/world/road/decks.hpp"
#include "common/world/road/one_ground.hpp"

namespace rodeira::road {

// A bound of the land's height at a point by a place on a road's edge: it differs from a height by at most a slope
// times a distance; with the changes of these as the point moves.
struct LandBound {
  double z_m = 0.0, distance_m = 0.0;
  Eigen::Vector2d z_slope_W = Eigen::Vector2d::Zero(), distance_slope_W = Eigen::Vector2d::Zero();
};

class LandBounds;

// Where the tightest two bounds leave no land of the slope kBank: which others may matter at the least slope at which
// all bounds meet, which is steeper.
class SteeperBounds {
 public:
  explicit SteeperBounds(const LandBounds& tightest);

  // What lies between two heights matters only where it is no farther than this (m).
  double Within_m(double lowest_m, double highest_m) const {
    return std::max({farther_m_,
                     std::max(highest_m - tightest_low_m_, tightest_high_m_ - lowest_m) / kBank + kRounding_m,
                     (highest_m - low_m_) / slope_, (high_m_ - lowest_m) / slope_});
  }

 private:
  static constexpr double kRounding_m = 1e-6;
  double tightest_low_m_, tightest_high_m_, slope_, low_m_, high_m_, farther_m_;
};

// The tightest lower and upper bounds at a point for the slope kBank, independent of the order in which bounds are
// added: of equal ones that of the lowest rank, and within a rank the first. Without bounds the interval is
// infinite.
class LandBounds {
 public:
  // every: keeps all bounds, which must be added by ascending rank.
  void Clear(bool every) {
    low_ = high_ = {}, low_m_ = -kInfinity, high_m_ = nearest_m_ = kInfinity, every_ = every, all_.clear();
    steeper_ = nullptr;
  }
  // All are kept of which this does not say that they do not matter; it must outlive the next Meet or Clear.
  void ClearForSteeper(const SteeperBounds& steeper) { Clear(true), steeper_ = &steeper; }
  void Rank(std::uint32_t rank) { rank_ = rank; }       // of the bounds added next
  void Leads() { low_rank_ = high_rank_ = 0; }          // bounds added so far precede all ranks from 1 on
  void Add(const LandBound& bound, double distance_m);  // distance_m: to its place

  const LandBound& low() const { return low_; }
  const LandBound& high() const { return high_; }
  double low_m() const { return low_m_; }
  double high_m() const { return high_m_; }
  double nearest_m() const { return nearest_m_; }
  bool every() const { return every_; }
  const SteeperBounds* steeper() const { return steeper_; }
  // What lies between two heights can hold the land tighter only where it is nearer than this. Not positive: nowhere.
  double TightensWithin(double lowest_m, double highest_m) const {
    return std::max(highest_m - low_m_, high_m_ - lowest_m) / kBank;
  }
  // In the middle of both; where the lower is the greater one, at the least slope by which all that were kept meet. On
  // roads that lie over one another none does: then in the middle between their heights.
  PlaneHeight Meet() const;

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LandBound low_, high_;
  double low_m_ = -kInfinity, high_m_ = kInfinity, nearest_m_ = kInfinity;
  std::uint32_t rank_ = 0, low_rank_ = 0, high_rank_ = 0;
  bool every_ = false;
  std::vector<LandBound> all_;
  const SteeperBounds* steeper_ = nullptr;
};

}  // namespace rodeira::road

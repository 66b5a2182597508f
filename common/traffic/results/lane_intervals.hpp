// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/traffic/results/lane_statistics.hpp"

namespace rodeira::traffic {

// What each track has seen in each of equal stretches of time, one behind the other: differences of the sums of
// LaneStatistics, which it looks at.
class LaneIntervals {
 public:
  struct Track {
    double distance_m = 0.0, time_s = 0.0;          // driven on it and spent there, by all
    std::int64_t in = 0, out = 0;                   // middles that came onto it, and left it
    std::int64_t queue_longest = 0, queue_sum = 0;  // vehicles slower than 5 km/h, over the looks
  };
  // A stretch of time, by track.
  struct Interval {
    double from_s = 0.0, to_s = 0.0;
    std::int64_t looks = 0;  // at queues
    std::vector<Track> tracks;
  };

  // The sums as they are now; begin_s: the time that this is.
  LaneIntervals(const LaneStatistics& statistics, std::size_t tracks, double begin_s);

  // After each LaneStatistics::LookAtQueues.
  void LookAtQueues(const LaneStatistics& statistics);
  // At the end of each stretch.
  void Note(const LaneStatistics& statistics);

  const std::vector<Interval>& all() const { return all_; }

 private:
  std::vector<Track> SumsOf(const LaneStatistics& statistics) const;

  double begin_s_;
  std::vector<Track> before_;  // the sums at the end of the last one
  Interval now_;               // its queues as yet
  std::vector<Interval> all_;
};

}  // namespace rodeira::traffic

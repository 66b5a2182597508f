// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/lane_intervals.hpp"

#include <algorithm>

namespace rodeira::traffic {

LaneIntervals::LaneIntervals(const LaneStatistics& statistics, std::size_t tracks, double begin_s)
    : begin_s_(begin_s), before_(tracks) {
  before_ = SumsOf(statistics);
  now_.from_s = begin_s, now_.tracks.resize(tracks);
}

std::vector<LaneIntervals::Track> LaneIntervals::SumsOf(const LaneStatistics& statistics) const {
  std::vector<Track> sums(before_.size());
  for (std::uint32_t track = 0; track < sums.size(); ++track) {
    for (const LaneCell& cell : statistics.CellsOf(track))
      sums[track].distance_m += cell.distance_m, sums[track].time_s += cell.time_s;
    const LaneCount& count = statistics.CountOf(track);
    sums[track].in = count.in, sums[track].out = count.out;
  }
  return sums;
}

void LaneIntervals::LookAtQueues(const LaneStatistics& statistics) {
  ++now_.looks;
  for (std::uint32_t track = 0; track < now_.tracks.size(); ++track) {
    const std::int64_t queue = statistics.QueueNow(track);
    now_.tracks[track].queue_sum += queue,
        now_.tracks[track].queue_longest = std::max(now_.tracks[track].queue_longest, queue);
  }
}

void LaneIntervals::Note(const LaneStatistics& statistics) {
  std::vector<Track> sums = SumsOf(statistics);
  now_.to_s = begin_s_ + statistics.watched_s();
  for (std::size_t track = 0; track < sums.size(); ++track) {
    Track& of = now_.tracks[track];
    of.distance_m = sums[track].distance_m - before_[track].distance_m,
    of.time_s = sums[track].time_s - before_[track].time_s;
    of.in = sums[track].in - before_[track].in, of.out = sums[track].out - before_[track].out;
  }
  before_ = std::move(sums);
  Interval next{now_.to_s, now_.to_s, 0, std::vector<Track>(before_.size())};
  all_.push_back(std::move(now_));
  now_ = std::move(next);
}

}  // namespace rodeira::traffic

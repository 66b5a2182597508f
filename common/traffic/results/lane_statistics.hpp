// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {

// What a stretch of a lane has seen: sums over all vehicles' middles (Edie 1963).
struct LaneCell {
  double distance_m = 0.0;  // driven in it
  double time_s = 0.0;      // spent in it
  double fuel_mg = 0.0;     // burnt in it

  // Of a stretch of a length, watched for a time: flow q = distance/(length · time), density k = time/(length · time),
  // mean speed v = distance/time; so q = k v. A stretch without a vehicle has the speed 0.
  double Flow_vehps(double length_m, double watched_s) const { return distance_m / (length_m * watched_s); }
  double Density_vehpm(double length_m, double watched_s) const { return time_s / (length_m * watched_s); }
  double Speed_mps() const { return time_s > 0.0 ? distance_m / time_s : 0.0; }
};

// A vehicle that is slower waits, as in SUMO's trip information.
inline constexpr double kWaiting_mps = 0.1;

// One vehicle's way through the network.
struct LaneTrip {
  std::uint32_t id = 0;
  VehicleKind kind = VehicleKind::kCar;
  std::uint32_t from = 0, to = 0;  // tracks: where it came onto the road, and where its middle was last
  double entered_s = -1.0;         // since the watching began; below 0: was there then
  double took_s = 0.0;             // until it left
  double fuel_mg = 0.0;
  double free_s = 0.0;     // what the same way takes at the free speed of each place (TrafficModel::FreeSpeed_mps)
  std::int32_t flow = -1;  // it belongs to, of the settings' in their order; below 0: none
  LeaveReason left = LeaveReason::kNetworkEnd;
  double way_m = 0.0;      // driven
  double waiting_s = 0.0;  // slower than kWaiting_mps
};

// Vehicles of a lane: there at the beginning, come, and gone.
struct LaneCount {
  std::int64_t began = 0, in = 0, out = 0;

  std::int64_t there() const { return began + in - out; }
};

// Sums for every metre (or so) of every lane, by watching a model after each step. The way of a step is shared out
// exactly among the cells that it crosses, its time and fuel in the same shares. What a vehicle does within a cell is
// summed up beside the vehicle and told to the cell when it leaves it, or at a query: cells lie in far memory, and
// most steps lead to no other one.
class LaneStatistics {
 public:
  // As many cells a track as make them nearly cell_m (over 0) long. The model is as it begins.
  LaneStatistics(const TrafficModel& model, double cell_m = 1.0);

  // After each step of dt_s.
  void Add(const TrafficModel& model, double dt_s);

  // Now and then: how many on each track are slower than 5 km/h.
  void LookAtQueues(const TrafficModel& model);

  double watched_s() const { return watched_s_; }
  // As of now; what was given before holds no more once Add has been called.
  std::span<const LaneCell> CellsOf(std::uint32_t track) const {
    if (pending_) PourAll();
    return {cells_.data() + tracks_[track].first, tracks_[track].count};
  }
  // All cells of a track are equally long.
  double CellLength_m(std::uint32_t track) const { return tracks_[track].cell_m; }
  // In the middle of a cell, whatever was there (TrafficModel::FreeSpeed_mps).
  double FreeSpeed_mps(std::uint32_t track, std::size_t cell) const { return free_mps_[tracks_[track].first + cell]; }

  // Of a track, over all looks: the longest and the mean queue, vehicles.
  std::int64_t LongestQueue(std::uint32_t track) const { return queues_[track].longest; }
  // Of a track, at the last look.
  std::int64_t QueueNow(std::uint32_t track) const { return queues_[track].now; }
  double MeanQueue(std::uint32_t track) const {
    return looks_ > 0 ? static_cast<double>(queues_[track].sum) / static_cast<double>(looks_) : 0.0;
  }

  // Since the beginning: vehicles that came, that left, and that are there. began + entered - left = there, always.
  std::int64_t began() const { return began_; }
  std::int64_t entered() const { return entered_; }
  std::int64_t left() const { return left_; }
  std::int64_t there() const { return there_; }
  // Of trips that began and ended while watched, in the order of their ends.
  const std::vector<LaneTrip>& trips() const { return trips_; }
  // Of a track: vehicles with a middle on it at first, that came onto it (from another lane, or into the network), and
  // left it: began + in - out = there.
  const LaneCount& CountOf(std::uint32_t track) const { return counts_[track]; }
  // Of each vehicle, over all its trips.
  const std::vector<double>& fuel_mg() const { return fuel_mg_; }

 private:
  // A vehicle as it was seen last, in one line of memory.
  struct alignas(64) Seen {
    double o_m = 0.0;
    double until_m = kNowhere_m;  // odometer up to which it is in its cell, whatever it does …
    LaneCell sum;                 // … and what it has done there since the cell was told
    double free_s = 0.0;          // of its trip, up to that cell
    std::uint32_t trip = 0;
    std::uint32_t cell = 0;  // of all cells, the one that it was seen in last
    bool on_road = false;
  };
  struct Queue {
    std::int64_t now = 0, sum = 0, longest = 0;
  };
  // A track's among all cells.
  struct Cells {
    std::size_t first = 0, count = 0;
    double cell_m = 0.0;
  };
  static constexpr double kNowhere_m = -1e18;

  void Distribute(const TrafficModel& model, std::uint32_t id, double from_m, double to_m, const LaneCell& sum);
  void EnterTrack(std::uint32_t id, std::uint32_t track);
  void Pour(Seen& seen) const;
  void PourAll() const;
  void FetchFor(const TrafficModel& model, std::uint32_t id) const;

  std::vector<Cells> tracks_;
  mutable std::vector<LaneCell> cells_;  // track by track
  mutable std::vector<Seen> seen_;       // by vehicle
  mutable bool pending_ = false;         // a vehicle's sum may not have been told to its cell
  std::vector<double> free_mps_;         // by cell
  std::vector<Queue> queues_;            // by track
  std::int64_t looks_ = 0;
  std::vector<double> fuel_mg_;
  std::vector<LaneTrip> now_;  // by vehicle: its trip as yet, `to` the track that its middle is on
  std::vector<LaneTrip> trips_;
  std::vector<LaneCount> counts_;  // by track
  double watched_s_ = 0.0;
  std::int64_t began_ = 0, entered_ = 0, left_ = 0, there_ = 0;
};

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/lane_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/core/base/huge_pages.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kQueuing_mps = 5.0 / 3.6;
constexpr double kCellEndMargin_m = 0.3;     // a vehicle this near to the end of its cell may leave it in the next step
constexpr std::uint32_t kCellPrefetch = 16;  // vehicles ahead with cells that are prefetched

double FreeTime_s(double way_m, double free_mps) { return free_mps > 0.0 ? way_m / free_mps : 0.0; }

}  // namespace

LaneStatistics::LaneStatistics(const TrafficModel& model, double cell_m)
    : seen_(model.vehicles()), fuel_mg_(model.vehicles(), 0.0), now_(model.vehicles()) {
  RODEIRA_ASSERT(cell_m > 0.0);
  queues_.resize(model.graph().tracks().size());
  counts_.resize(model.graph().tracks().size());
  for (const lanes::Track& track : model.graph().tracks()) {
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(track.length_m() / cell_m)));
    const auto index = static_cast<std::uint32_t>(tracks_.size());
    tracks_.push_back({free_mps_.size(), count, track.length_m() / static_cast<double>(count)});
    for (std::size_t cell = 0; cell < count; ++cell)
      free_mps_.push_back(model.FreeSpeed_mps(index, (static_cast<double>(cell) + 0.5) * tracks_.back().cell_m));
  }
  RODEIRA_ASSERT(free_mps_.size() < std::numeric_limits<std::uint32_t>::max());
  cells_.resize(free_mps_.size());
  base::PreferHugePages(cells_);
  base::PreferHugePages(seen_);
  for (std::uint32_t id = 0; id < model.vehicles(); ++id) {
    const Agent& agent = model.agent(id);
    seen_[id].on_road = agent.on_road, seen_[id].trip = agent.trip, seen_[id].o_m = agent.o_m;
    if (!agent.on_road) continue;
    ++began_;
    now_[id].to = PieceAt(agent.path, agent.o_m).track;
    ++counts_[now_[id].to].began;
  }
  there_ = began_;
}

// The cell is told what a vehicle has done in it.
void LaneStatistics::Pour(Seen& seen) const {
  if (seen.sum.time_s <= 0.0) return;
  LaneCell& cell = cells_[seen.cell];
  cell.distance_m += seen.sum.distance_m, cell.time_s += seen.sum.time_s, cell.fuel_mg += seen.sum.fuel_mg;
  seen.free_s += FreeTime_s(seen.sum.distance_m, free_mps_[seen.cell]);
  seen.sum = {};
}

void LaneStatistics::PourAll() const {
  for (Seen& seen : seen_) Pour(seen);
  pending_ = false;
}

// Its middle is on that track now.
void LaneStatistics::EnterTrack(std::uint32_t id, std::uint32_t track) {
  if (now_[id].to == track) return;
  ++counts_[now_[id].to].out, ++counts_[track].in;
  now_[id].to = track;
}

// The way from one odometer to another, piece by piece and cell by cell. What lies before the path that is still known
// counts to its first piece. Pieces that come later begin at its front bumper or beyond, so that as far as there the
// last cell is its own.
void LaneStatistics::Distribute(const TrafficModel& model, std::uint32_t id, double from_m, double to_m,
                                const LaneCell& sum) {
  const auto& path = model.agent(id).path;
  const double way = to_m - from_m, sure_m = to_m + 0.5 * model.traits(id).length_m;
  Seen& seen = seen_[id];
  seen.until_m = kNowhere_m;
  double at = from_m;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool last = i + 1 == path.size();
    if (!last && path[i + 1].begin_m <= at && path[i + 1].begin_m < to_m) continue;
    EnterTrack(id, path[i].track);
    const double end = last ? to_m : std::min(to_m, path[i + 1].begin_m);
    const auto& [first, count, length] = tracks_[path[i].track];
    LaneCell* const cells = cells_.data() + first;
    const auto cell_at = [&](double o_m) {
      const double cell = std::floor((o_m - path[i].zero_m) / length);
      return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
    };
    if (way <= 0.0) {
      LaneCell& cell = cells[cell_at(at)];
      cell.time_s += sum.time_s, cell.fuel_mg += sum.fuel_mg;
      return;
    }
    for (std::size_t cell = cell_at(at); at < end; ++cell) {
      const double to =
          cell + 1 >= count ? end : std::min(end, path[i].zero_m + static_cast<double>(cell + 1) * length);
      const double share = std::max(0.0, to - at) / way;
      cells[cell].distance_m += share * sum.distance_m;
      cells[cell].time_s += share * sum.time_s;
      cells[cell].fuel_mg += share * sum.fuel_mg;
      seen.free_s += FreeTime_s(share * sum.distance_m, free_mps_[first + cell]);
      seen.cell = static_cast<std::uint32_t>(first + cell);
      seen.until_m =
          std::min({last ? sure_m : path[i + 1].begin_m,
                    cell + 1 >= count ? sure_m : path[i].zero_m + static_cast<double>(cell + 1) * length, sure_m});
      at = std::max(at, to);
    }
    if (at >= to_m) return;
  }
}

void LaneStatistics::LookAtQueues(const TrafficModel& model) {
  for (Queue& queue : queues_) queue.now = 0;
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    if (agent.speed_mps >= kQueuing_mps) continue;
    std::size_t i = agent.path.size() - 1;
    while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
    ++queues_[agent.path[i].track].now;
  }
  for (Queue& queue : queues_) queue.sum += queue.now, queue.longest = std::max(queue.longest, queue.now);
  ++looks_;
}

void LaneStatistics::FetchFor(const TrafficModel& model, std::uint32_t id) const {
  const Agent& agent = model.agent(id);
  __builtin_prefetch(&agent);
  __builtin_prefetch(&agent.fuel_mgps);
  if (seen_[id].o_m + kCellEndMargin_m < seen_[id].until_m) return;
  __builtin_prefetch(&agent.path);
  __builtin_prefetch(&cells_[seen_[id].cell], 1);
}

void LaneStatistics::Add(const TrafficModel& model, double dt_s) {
  watched_s_ += dt_s;
  pending_ = true;
  for (const Leaver& leaver : model.leavers()) now_[leaver.id].left = leaver.reason;
  for (std::uint32_t id = 0; id < seen_.size(); ++id) {
    if (id + kCellPrefetch < seen_.size()) FetchFor(model, id + kCellPrefetch);
    const Agent& agent = model.agent(id);
    Seen& seen = seen_[id];
    const bool same = seen.on_road && agent.on_road && seen.trip == agent.trip;
    if (seen.on_road && !same) {
      ++left_, --there_;
      Pour(seen);
      LaneTrip& trip = now_[id];
      ++counts_[trip.to].out;
      trip.free_s = seen.free_s;
      if (trip.entered_s >= 0.0) trip.took_s = watched_s_ - trip.entered_s, trips_.push_back(trip);
    }
    if (agent.on_road && !same) {
      ++entered_, ++there_;
      const std::uint32_t track = PieceAt(agent.path, agent.o_m).track;
      now_[id] = {.id = id, .kind = model.traits(id).kind, .from = track, .to = track, .entered_s = watched_s_};
      now_[id].flow = agent.flow;
      seen.free_s = 0.0;
      ++counts_[track].in;
    }
    if (same) {
      const double way = agent.o_m - seen.o_m;
      fuel_mg_[id] += agent.fuel_mgps * dt_s;
      now_[id].fuel_mg += agent.fuel_mgps * dt_s;
      now_[id].way_m += way;
      if (agent.speed_mps < kWaiting_mps) now_[id].waiting_s += dt_s;
      const LaneCell step{way, dt_s, agent.fuel_mgps * dt_s};
      if (way >= 0.0 && agent.o_m < seen.until_m) {
        seen.sum.distance_m += step.distance_m, seen.sum.time_s += step.time_s, seen.sum.fuel_mg += step.fuel_mg;
      } else {
        Pour(seen);
        Distribute(model, id, seen.o_m, agent.o_m, step);
      }
    } else {
      seen.until_m = kNowhere_m;
    }
    seen.on_road = agent.on_road;
    seen.trip = agent.trip;
    seen.o_m = agent.o_m;
  }
}

}  // namespace rodeira::traffic

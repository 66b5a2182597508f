// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/arbitration.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/traffic/lane_change/turn.hpp"
#include "common/traffic/perception/each_driving.hpp"
#include "common/traffic/right_of_way/queueing.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::size_t kZonePrefetch = 6;  // agents ahead with zones that are prefetched

}  // namespace

void RightOfWay::Arbitrate(double dt_s, std::int64_t turn_ns) {
  out_.book.Clear();
  EachDriving(in_.pool, in_.agents, [&](std::uint32_t id) {
    if (!in_.people) out_.ahead[id] = in_.neighbours.FindLeader(id);
    out_.passages_ahead.ComeToLine(id, dt_s);
  });
  std::fill(out_.reaches.begin(), out_.reaches.end(), -1.0);
  out_.heads.clear(), out_.order.clear(), out_.coming.clear(), out_.held_up.clear();
  for (std::uint32_t id = 0; id < in_.agents.size(); ++id) {
    ConflictPassage& passage = out_.passages[id];
    if (!in_.agents[id].on_road) {
      passage.any = false, passage.key = {};
      continue;
    }
    out_.claims.FetchZones(id + kZonePrefetch);
    out_.claims.HoldZones(id);
    if (!in_.agents[id].grants.empty() && in_.agents[id].speed_mps < kStandstill_mps) out_.held_up.push_back(id);
  }
  for (std::uint32_t id = 0; id < in_.agents.size();
       ++id) {  // how far a leader comes depends on the holder of its zones
    ConflictPassage& passage = out_.passages[id];
    if (!passage.any) continue;
    out_.coming.push_back(id);
    if (!passage.due) continue;
    out_.room.TellComing(id);
    if (passage.red || passage.barred)
      passage.waits_for = -1;
    else if (passage.head && !passage.must_stop)
      out_.order.push_back(id);
    if (passage.head) out_.heads.push_back(id);
  }
  out_.claims.RequestZones();
  for (const std::uint32_t id : out_.coming) out_.claims.ComeToZones(id);
  out_.claims.OthersAtZones();
  // Those that have lost patience, by how long; then by when they come to the line, as told by their own motion; then
  // by number.
  std::sort(out_.order.begin(), out_.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double patience_a = out_.grants.Urgent(a) ? in_.agents[a].waited_s : 0.0,
                 patience_b = out_.grants.Urgent(b) ? in_.agents[b].waited_s : 0.0;
    if (patience_a != patience_b) return patience_a > patience_b;
    if (out_.passages[a].arrives_s != out_.passages[b].arrives_s)
      return out_.passages[a].arrives_s < out_.passages[b].arrives_s;
    return a < b;
  });
  for (const std::uint32_t id : out_.order) {
    ConflictPassage& passage = out_.passages[id];
    if (passage.able && out_.grants.Grant(id, true)) continue;
    if (out_.grants.GrantToWait(id)) continue;
    if (!out_.grants.Urgent(id)) {
      if (passage.able) out_.claims.ComeLater(id);
      continue;
    }
    // No other takes up what it waits for; nor, where there is not room enough for it yet, what there is of it, if
    // that one is shorter.
    const bool comes_free = !passage.able && passage.lacks_m < in_.traits[id].length_m + in_.settings.idm.min_gap_m;
    for (const Crossing& crossing : passage.crossings) {
      if (crossing.zone < 0 || !(passage.able || (comes_free && out_.grants.TakesRoom(crossing)))) continue;
      const auto zone = static_cast<std::size_t>(crossing.zone), theirs = static_cast<std::size_t>(1 - crossing.side);
      if (passage.able)
        out_.book.Await(zone, theirs);
      else
        out_.book.WantRoom(zone, theirs, {in_.agents[id].waited_s, id});
    }
  }
  for (const std::uint32_t id : out_.order) {  // … and now those that had to yield to such as cannot come yet
    if (out_.passages[id].any && out_.passages[id].able) out_.grants.Grant(id, true);
  }
  out_.deadlocks.ResolveDeadlocks();
  EachDriving(in_.pool, in_.agents, [&](std::uint32_t id) {
    out_.claims.FetchZones(id + kZonePrefetch);
    out_.merging.YieldInZones(id);
    const Agent& agent = in_.agents[id];
    out_.beside[id] = agent.change.side != 0 || in_.tracks.HasBeside(id, agent.path.back().track);
    out_.passes[id] = agent.overtaking.active() || agent.told_past ||
                      (in_.settings.overtaking.allowed && IsItsTurn(in_.time_ns, id, turn_ns));
  });
}

}  // namespace rodeira::traffic

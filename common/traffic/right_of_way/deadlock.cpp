// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/right_of_way/deadlock.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

// Beyond its minimum gap: a vehicle no farther behind another one queues behind it.
constexpr double kQueuedGap_m = 1.0;

}  // namespace

// The agent that a standing one waits for; below 0: none, or one that is no agent. One with a reservation waits for its
// leader only where it has come up to it, and else for the one that keeps it in its own zones.
std::int64_t Deadlocks::WaitsFor(std::uint32_t id) const {
  if (out_.agents[id].speed_mps > kStandstill_mps) return -1;
  const Leader& ahead = in_.ahead[id];
  const ConflictPassage& passage = in_.passages[id];
  const bool is_in = !out_.agents[id].grants.empty();
  if (is_in && ahead.id >= 0 && ahead.gap_m < in_.traits[id].idm.min_gap_m + kQueuedGap_m) return ahead.id;
  const std::int64_t keeps = is_in ? in_.merging.KeptInZonesBy(id) : -1;
  if (keeps >= 0) return keeps;
  if (passage.any && passage.head && passage.due) return passage.waits_for;
  return !is_in && ahead.any ? ahead.id : -1;
}

// The circle in which a chain closes, from where it does; empty where it does not, or comes to one that has been
// `seen`.
std::vector<std::uint32_t> Deadlocks::FindWaitCycle(std::uint32_t start, std::vector<std::uint8_t>& seen) const {
  std::vector<std::uint32_t> chain;
  std::int64_t at = start;
  while (at >= 0 && static_cast<std::size_t>(at) < out_.agents.size() && seen[static_cast<std::size_t>(at)] == 0) {
    seen[static_cast<std::size_t>(at)] = 1;
    chain.push_back(static_cast<std::uint32_t>(at));
    at = WaitsFor(static_cast<std::uint32_t>(at));
  }
  if (at < 0) return {};
  return {std::find(chain.begin(), chain.end(), static_cast<std::uint32_t>(at)), chain.end()};
}

// Gives the zones back that were granted to it, but for those that it stands in, and asks for them anew, unless
// another holds one of those it stands in: none counts on it in the others, and it stands where it would have
// waited.
bool Deadlocks::RevokeReservation(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  if (agent.grants.empty()) return false;
  const double front = FrontOf(out_.agents[id], in_.traits[id]), rear = front - in_.traits[id].length_m,
               to = front - kZoneOverhang_m;
  if (agent.granted_m <= to) return false;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear || !stretch.crosses) continue;
    for (const lanes::ZoneSide& part : in_.map.zones.ConflictsOf(stretch.track)) {
      if (stretch.zero_m + part.in_m >= to || stretch.zero_m + part.out_m <= rear) continue;
      for (const Reservation& holder : in_.book.ReservationsOf(part.zone, static_cast<std::size_t>(1 - part.side))) {
        if (holder.id != id) return false;
      }
    }
  }
  agent.grants.clear();
  agent.granted_m = to;
  out_.passages_ahead.FindPassage(id);
  return true;
}

// Whether the vehicle waits at a line and can be granted its zones now.
bool Deadlocks::IsAtLine(std::uint32_t id) const {
  const ConflictPassage& passage = in_.passages[id];
  return passage.any && passage.head && passage.due && !passage.must_stop && !passage.red && !passage.barred;
}

// Whether one of them keeps another one out of a zone.
bool Deadlocks::AreInOneAnothersWay(std::span<const std::uint32_t> some) const {
  std::vector<std::size_t> sides;
  for (const std::uint32_t id : some) {
    for (const Crossing& crossing : in_.passages[id].crossings) {
      if (crossing.zone >= 0)
        sides.push_back(
            ReservationTable::Side(static_cast<std::size_t>(crossing.zone), static_cast<std::size_t>(crossing.side)));
    }
  }
  std::sort(sides.begin(), sides.end());
  return std::any_of(sides.begin(), sides.end(), [&](std::size_t side) {
    return side % 2 == 0 && std::binary_search(sides.begin(), sides.end(), side + 1);
  });
}

// Gives reservations to those of the circle, each of which waits for the next one, that block no other, although they
// would have to yield, and whether any was given. First those with room, the longest waiting first (of equals the
// first). Then one without room since those that stand there wait, one behind another, for one that goes now. Where
// none has any all of them go at once or, if one cannot, one that comes to block none of them: one that went in
// else though those before it stay where they are would stand in the zones, in the way of all others, and for good
// where they wait for one that it blocks.
bool Deadlocks::GrantCycle(const std::vector<std::uint32_t>& circle) {
  struct AtLine {
    std::uint32_t id = 0;
    std::size_t next = 0;  // of those at a line that those before it wait for
    bool goes = false;
  };
  std::vector<AtLine> lines;
  for (const std::uint32_t id : circle) {
    const ConflictPassage& passage = in_.passages[id];
    if (passage.any && passage.head && passage.due) lines.push_back({id, lines.size() + 1});
  }
  if (lines.empty()) return false;
  lines.back().next = 0;
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double waited_a = out_.agents[lines[a].id].waited_s, waited_b = out_.agents[lines[b].id].waited_s;
    return waited_a != waited_b ? waited_a > waited_b : lines[a].id < lines[b].id;
  });
  bool any = false;
  const auto let_in = [&](AtLine& line) {
    line.goes = IsAtLine(line.id) && out_.grants.Grant(line.id, false);
    any = any || line.goes;
    return line.goes;
  };
  for (const std::size_t i : order) {
    if (in_.passages[lines[i].id].able) let_in(lines[i]);
  }
  std::vector<std::uint8_t> tried(lines.size(), 0);
  for (bool more = any; more;) {
    more = false;
    for (const std::size_t i : order) {
      if (tried[i] != 0 || lines[i].goes || in_.passages[lines[i].id].able || !lines[lines[i].next].goes) continue;
      tried[i] = 1;
      more = let_in(lines[i]) || more;
    }
  }
  if (any) return true;
  std::vector<std::uint32_t> all;
  bool free = true;
  for (const AtLine& line : lines) {
    all.push_back(line.id);
    free = free && IsAtLine(line.id) && !in_.passages[line.id].able && !out_.grants.IsHeld(line.id);
  }
  if (free && !AreInOneAnothersWay(all)) {
    for (const std::size_t i : order) let_in(lines[i]);
    return any;
  }
  for (const std::size_t i : order) {  // … or one that comes to block none of them
    const ConflictPassage& passage = in_.passages[lines[i].id];
    const double rear = passage.end_m + kLoose_m - passage.lacks_m;  // behind the one that stands there
    const auto keeps_out = [&](const Crossing& mine) {
      return mine.zone >= 0 && mine.out_m > rear && std::any_of(all.begin(), all.end(), [&](std::uint32_t other) {
               const auto& theirs = in_.passages[other].crossings;
               return other != lines[i].id && std::any_of(theirs.begin(), theirs.end(), [&](const Crossing& their) {
                        return their.zone == mine.zone && their.side != mine.side;
                      });
             });
    };
    if (!passage.able && std::none_of(passage.crossings.begin(), passage.crossings.end(), keeps_out) &&
        let_in(lines[i]))
      return true;
  }
  return false;
}

// Where none of the circle can get a reservation, since one with a reservation stands behind one of them, that one
// waits outside: first one that has come up to a leader, of several the last reservation.
void Deadlocks::BreakDeadlock(std::vector<std::uint32_t> circle) {
  if (GrantCycle(circle)) return;
  const std::uint32_t first = circle.front();
  std::vector<std::uint8_t> seen(out_.agents.size(), 0);
  if (FindWaitCycle(first, seen).size() != circle.size()) return;  // the one that keeps them out is not one of them
  const auto is_behind = [&](std::uint32_t id) { return WaitsFor(id) == in_.ahead[id].id; };
  const auto number = [&](std::uint32_t id) {
    return out_.agents[id].grants.empty() ? 0 : out_.agents[id].grants.back().number;
  };
  std::sort(circle.begin(), circle.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (is_behind(a) != is_behind(b)) return is_behind(a);
    return number(a) != number(b) ? number(a) > number(b) : a < b;
  });
  for (const std::uint32_t id : circle) {
    if (RevokeReservation(id)) return;
  }
}

void Deadlocks::ResolveDeadlocks() {
  std::vector<std::uint8_t> seen(out_.agents.size(), 0);  // on a chain that has been looked at
  const auto look_from = [&](std::uint32_t start) {
    if (seen[start] != 0) return;
    const auto circle = FindWaitCycle(start, seen);
    if (!circle.empty()) BreakDeadlock(circle);
  };
  for (const std::uint32_t id : in_.heads) {
    if (in_.passages[id].any) look_from(id);
  }
  for (const std::uint32_t id : in_.held_up) look_from(id);
}

}  // namespace rodeira::traffic

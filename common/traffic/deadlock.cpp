// What becomes of a chain of who waits for whom that closes.
#include <algorithm>
#include <vector>

#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kAtRest_mps = 0.05;
constexpr double kClose_m = 1.0;     // more than its standing gap from who is ahead: it stands for him
constexpr double kOverLine_m = 0.3;  // a front so far beyond where a zone begins still waits before it (claims.cpp)

}  // namespace

// Whom who stands waits for; below 0: nobody, or somebody who is no agent. Who has been let in waits for who is ahead only where it has come up to him, and else for who keeps it in its own zones.
std::int64_t TrafficModel::WaitsFor(std::uint32_t id) const {
  if (agents_[id].speed_mps > kAtRest_mps) return -1;
  const Ahead& ahead = ahead_[id];
  const Passage& passage = passages_[id];
  const bool is_in = !agents_[id].grants.empty();
  if (is_in && ahead.id >= 0 && ahead.gap_m < traits_[id].idm.standing_gap_m + kClose_m) return ahead.id;
  const std::int64_t keeps = is_in ? KeptInZonesBy(id) : -1;
  if (keeps >= 0) return keeps;
  if (passage.any && passage.head && passage.due) return passage.waits_for;
  return !is_in && ahead.any ? ahead.id : -1;
}

// The circle in which a chain closes, from where it does; empty where it does not, or comes to one that has been `seen`.
std::vector<std::uint32_t> TrafficModel::CircleOf(std::uint32_t start, std::vector<std::uint8_t>& seen) const {
  std::vector<std::uint32_t> chain;
  std::int64_t at = start;
  while (at >= 0 && static_cast<std::size_t>(at) < agents_.size() && seen[static_cast<std::size_t>(at)] == 0) {
    seen[static_cast<std::size_t>(at)] = 1;
    chain.push_back(static_cast<std::uint32_t>(at));
    at = WaitsFor(static_cast<std::uint32_t>(at));
  }
  if (at < 0) return {};
  return {std::find(chain.begin(), chain.end(), static_cast<std::uint32_t>(at)), chain.end()};
}

// Gives the zones back that were granted to it, but for those that it stands in, and asks for them anew, unless somebody else holds one of those it stands in: nobody counts on it in the others,
// and it stands where it would have waited.
bool TrafficModel::GiveBack(std::uint32_t id) {
  Agent& agent = agents_[id];
  if (agent.grants.empty()) return false;
  const double front = FrontOf(id), rear = front - traits_[id].length_m, to = front - kOverLine_m;
  if (agent.granted_m <= to) return false;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to) break;
    if (stretch.end_m < rear || !stretch.crosses) continue;
    for (const lanes::ZoneSide& part : zones().ConflictsOf(stretch.track)) {
      if (stretch.zero_m + part.in_m >= to || stretch.zero_m + part.out_m <= rear) continue;
      for (const Holder& holder : book_.HoldersOf(part.zone, static_cast<std::size_t>(1 - part.side))) {
        if (holder.id != id) return false;
      }
    }
  }
  agent.grants.clear();
  agent.granted_m = to;
  FindPassage(id);
  return true;
}

// Those of the circle go who are not in one another's way, who has waited longest first (of equals the first), although they would have to yield, or though there is no room behind
// yet because those who stand there are in the circle. Where nobody can, since somebody has been let in who stands behind one of them, he waits outside: first he who
// has come up to somebody ahead, of several he who was let in last.
void TrafficModel::OpenCircle(std::vector<std::uint32_t> circle) {
  const std::uint32_t first = circle.front();
  std::sort(circle.begin(), circle.end(), [&](std::uint32_t a, std::uint32_t b) {
    return agents_[a].waited_s != agents_[b].waited_s ? agents_[a].waited_s > agents_[b].waited_s : a < b;
  });
  bool goes = false;
  for (const std::uint32_t id : circle) {
    const Passage& passage = passages_[id];
    if (passage.any && passage.head && passage.due && !passage.must_stop && !passage.red && !passage.barred) goes = Grant(id, false) || goes;
  }
  if (goes) return;
  std::vector<std::uint8_t> seen(agents_.size(), 0);
  if (CircleOf(first, seen).size() != circle.size()) return;  // who keeps them out is not one of them
  const auto is_behind = [&](std::uint32_t id) { return WaitsFor(id) == ahead_[id].id; };
  const auto number = [&](std::uint32_t id) { return agents_[id].grants.empty() ? 0 : agents_[id].grants.back().number; };
  std::sort(circle.begin(), circle.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (is_behind(a) != is_behind(b)) return is_behind(a);
    return number(a) != number(b) ? number(a) > number(b) : a < b;
  });
  for (const std::uint32_t id : circle) {
    if (GiveBack(id)) return;
  }
}

void TrafficModel::ResolveDeadlocks() {
  std::vector<std::uint8_t> seen(agents_.size(), 0);  // on a chain that has been looked at
  const auto look_from = [&](std::uint32_t start) {
    if (seen[start] != 0) return;
    const auto circle = CircleOf(start, seen);
    if (!circle.empty()) OpenCircle(circle);
  };
  for (const std::uint32_t id : heads_) {
    if (passages_[id].any) look_from(id);
  }
  for (const std::uint32_t id : held_up_) look_from(id);
}

}  // namespace rodeira::traffic

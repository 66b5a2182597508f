// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/entering.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/driving/driver/idm.hpp"
#include "common/traffic/demand/spawn.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLane = 102;
constexpr double kEnteringShare = 0.95;  // of the speed it wants
constexpr double kEnteringBrake = 0.9;   // share of its comfortable braking before the first line
constexpr double kUntouched_m = 0.4;     // between a vehicle that enters by MOTORS' rule and its leader, at least

// How far on a lane the rear bumper of a vehicle is that enters: at the beginning, or, where no other entry is wider
// and the lane opens there, where it is as wide as a vehicle.
double EntersAt_m(const lanes::Graph& graph, std::uint32_t track) {
  const auto& nodes = graph[track].curve.nodes();
  if (graph.says_entries() || nodes.front().width_m >= kMinSpawnWidth_m) return 0.0;
  const auto wide = std::find_if(nodes.begin(), nodes.end(),
                                 [](const lanes::Curve::Node& node) { return node.width_m >= kMinSpawnWidth_m; });
  return wide == nodes.end() ? 0.0 : wide->d_m;
}

}  // namespace

std::uint32_t Entering::DrawEntry(std::uint32_t id, std::uint32_t trip) const {
  return in_.map.DrawEntry(base::RandomBits({in_.settings.seed, id, kDrawLane, trip}));
}

double Entering::AtMostForLine(std::uint32_t id) {
  out_.passages_ahead.FindPassage(id);
  out_.passages[id].key = {};
  if (!std::exchange(out_.passages[id].any, false)) return Agent::kNoCap_mps;
  const double way = out_.passages[id].line_m - out_.agents[id].o_m - 0.5 * in_.traits[id].length_m;
  const double b = kEnteringBrake * in_.traits[id].idm.braking_mps2, j = in_.settings.smooth.planned_mps3,
               grows = b / (2.0 * j);
  const double eased = std::max(0.0, way - b * b * b / (24.0 * j * j));
  return std::min(b * (std::sqrt(grows * grows + 2.0 * eased / b) - grows),
                  std::cbrt(std::max(0.0, way) * std::max(0.0, way) * j));  // v²/(2 b) + v b/(2 j); v √(v/j)
}

LeaveReason Entering::ReasonOf(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  const std::uint32_t track = agent.path.back().track;
  const Route* route = RouteOf(in_.map, agent);
  if (route == nullptr) return in_.map.lane_ends.IsBlunt(track) ? LeaveReason::kLaneEnd : LeaveReason::kNetworkEnd;
  if (agent.leg >= route->legs()) return LeaveReason::kRouteEnd;
  return route->Reaches(agent.leg, track) ? LeaveReason::kLaneEnd : LeaveReason::kRouteMissed;
}

// What is left of it for its next trip.
void Entering::Clear(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  const std::uint32_t trip = agent.trip + 1;
  const double driven = agent.driven_m;
  agent = Agent();
  if (out_.full) out_.full->Clear(id);
  agent.trip = trip;
  agent.driven_m = driven;
}

void Entering::Leave(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  out_.leavers.push_back({id, ReasonOf(id)});
  Clear(id);
  if (id >= in_.settings.vehicles) return;  // a scenario's
  ++out_.ended;
  if (!in_.flows.empty()) return;  // the next vehicle of a flow is another one
  agent.entry = DrawEntry(id, agent.trip);
  out_.waiting.push_back(id);
}

void Entering::Remove(std::uint32_t id) {
  if (out_.agents[id].on_road || out_.agents[id].is_crashed) out_.leavers.push_back({id, LeaveReason::kRemoved});
  Clear(id);
  std::erase(out_.waiting, id);
}

// At each entry the first that waits there. The vehicle on it, or, where that lies in the middle of the network, on the
// way there, is looked for once for all.
void Entering::Enter() {
  if (out_.waiting.empty()) return;
  out_.present.Clear();
  out_.expected.assign(in_.map.graph.tracks().size(), 0);
  const bool among_others = std::any_of(out_.waiting.begin(), out_.waiting.end(),
                                        [&](std::uint32_t id) { return IsAmongOthers(out_.agents[id].entry); });
  const auto appear = [&](std::uint32_t id) {
    for (const Piece& piece : out_.agents[id].path) {
      if (in_.map.watched[piece.track]) out_.present.Add(piece.track, id);
    }
    if (!among_others) return;
    const double front = out_.agents[id].o_m + 0.5 * in_.traits[id].length_m,
                 sight = out_.ways.SightOf(out_.agents[id]);
    for (const RouteSegment& stretch : in_.stretches[id]) {
      if (stretch.begin_m > front - 1.0 && stretch.begin_m - front < sight) out_.expected[stretch.track] = 1;
    }
  };
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    if ((among_others || in_.at_entry[id] != 0) && out_.agents[id].on_road) appear(id);
  }
  std::vector<bool> tried(in_.map.graph.tracks().size(), false);
  std::vector<std::uint32_t> left;
  for (const std::uint32_t id : out_.waiting) {
    const std::uint32_t entry = out_.agents[id].entry;
    if (tried[entry] || !TryEnter(id))
      left.push_back(id);
    else
      appear(id);
    tried[entry] = true;
  }
  out_.waiting = std::move(left);
}

// Whether a vehicle may come to a track's beginning, or to that of one that parts from it.
bool Entering::IsAmongOthers(std::uint32_t track) const {
  const auto partings = in_.map.zones.DivergeZonesOf(track);
  return !in_.map.graph[track].before.empty() ||
         std::any_of(partings.begin(), partings.end(),
                     [&](const lanes::DivergeZone& part) { return !in_.map.graph[part.other].before.empty(); });
}

// Whether a vehicle is on its way to a track's beginning, or to that of one that parts from it, or is not clear of it
// yet on such a one.
bool Entering::IsExpected(std::uint32_t track, double gap_m) const {
  if (IsAmongOthers(track) && out_.expected[track] != 0) return true;
  for (const lanes::DivergeZone& part : in_.map.zones.DivergeZonesOf(track)) {
    if (out_.expected[part.other] != 0) return true;
    for (const std::uint32_t other : out_.present.Of(part.other)) {
      for (const Piece& piece : out_.agents[other].path) {
        if (piece.track == part.other &&
            out_.agents[other].o_m - 0.5 * in_.traits[other].length_m - piece.zero_m < part.other_out_m + gap_m)
          return true;
      }
    }
  }
  return false;
}

// With its rear bumper at the lane's beginning (EntersAt_m), at its own speed or at that of the car ahead, once the gap
// bears it.
bool Entering::TryEnter(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  const AgentTraits& traits = in_.traits[id];
  const double half = 0.5 * traits.length_m, at_m = EntersAt_m(in_.map.graph, agent.entry);
  const bool as_motors = in_.settings.enters == EnterRule::kFree;
  const double free_m = std::max(in_.settings.free_m, traits.length_m + kUntouched_m);  // of the lane, by that rule
  for (const Block& block : in_.blocks[agent.entry]) {
    if (block.span.rear_m < at_m + (as_motors ? free_m : traits.length_m + traits.idm.min_gap_m) &&
        block.span.front_m > 0.0)
      return false;
  }
  const bool looks = in_.settings.driver != DriverKind::kMotors;  // beyond the lane that it enters
  if (looks && IsExpected(agent.entry, traits.idm.min_gap_m)) return false;
  Agent entering = agent;
  entering.on_road = true;
  entering.o_m = at_m + half;
  entering.path = {{agent.entry, 0.0, 0.0, 0.0, 0.0, 1.0}};
  std::swap(agent, entering);
  const auto wait = [&] {
    std::swap(agent, entering);
    return false;
  };
  out_.ways.FindRouteSegments(id, in_.settings.sight_m);
  const double limit = in_.map.plans[agent.entry].limit_mps * traits.speed_factor;
  double speed = kEnteringShare *
                 std::min(in_.limits.Allowed(id, out_.agents[id].o_m).speed_mps * traits.speed_factor, traits.top_mps);
  if (looks && !out_.claims.TakeFirstZones(id)) return wait();
  speed = std::min(speed, AtMostForLine(id));
  if (in_.people) speed = std::min(speed, in_.crosswalks.AtMostForPeople(id));
  if (speed < 0.0) return wait();
  // No vehicle may stand where it enters, not even with its rear; agents have moved since they were last seen.
  for (const std::uint32_t other : out_.present.Of(agent.entry)) {
    for (const Piece& piece : out_.agents[other].path) {
      const double rear = out_.agents[other].o_m - 0.5 * in_.traits[other].length_m - piece.zero_m;
      if (piece.track == agent.entry &&
          rear < at_m + (as_motors ? free_m : traits.length_m + 2.0 * traits.idm.min_gap_m))
        return wait();
    }
  }
  const Leader ahead = in_.neighbours.FindLeader(id);
  if (ahead.any) {
    const auto safe = [&](double v) {
      return ahead.gap_m > 2.0 * traits.idm.min_gap_m &&
             ahead.gap_m >= traits.idm.min_gap_m + v * traits.idm.time_gap_s &&
             driver::IdmAcceleration(traits.idm, v, limit, ahead.gap_m, ahead.speed_mps) > -kSpawnBraking_mps2;
    };
    if (!safe(speed)) speed = std::clamp(ahead.speed_mps, 0.0, speed);
    if (!as_motors && !safe(speed)) return wait();
  }
  agent.speed_mps = speed;
  out_.missed_now[id] = out_.paths.Follow(id);  // its front may be beyond a short lane already
  if (out_.full && !out_.full_motion.PlaceFull(id)) return wait();
  if (agent.granted_m > 0.0) {
    agent.grants = {{agent.granted_m, out_.next_grant++, false}};
    out_.claims.HoldZones(id);
  }
  out_.missed += out_.missed_now[id];
  return true;
}

}  // namespace rodeira::traffic

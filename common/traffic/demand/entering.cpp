// SPDX-License-Identifier: Apache-2.0
// How agents leave at a lane's end and enter again.
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/random.hpp"
#include "common/traffic/demand/spawn.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLane = 102;
constexpr double kEnteringShare = 0.95;         // of the speed it wants
constexpr double kEnteringBrake = 0.9;          // share of its comfortable braking before the first line
constexpr double kEntryStandingMargin_m = 2.0;  // beyond its length, to stand between two zones near its entry
constexpr double kUntouched_m = 0.4;            // between who enters by MOTORS' rule and who is ahead, at least

}  // namespace

// Where it enters on this trip: by lot.
std::uint32_t TrafficModel::DrawEntry(std::uint32_t id, std::uint32_t trip) const {
  return map_->DrawEntry(base::RandomBits({settings_.seed, id, kDrawLane, trip}));
}

// The speed from which it can stop before the first zones that are not its own.
double TrafficModel::AtMostForLine(std::uint32_t id) {
  FindPassage(id);
  passages_[id].key = {};
  if (!std::exchange(passages_[id].any, false)) return Agent::kNoCap_mps;
  const double way = passages_[id].line_m - agents_[id].o_m - 0.5 * traits_[id].length_m;
  const double b = kEnteringBrake * traits_[id].idm.braking_mps2, j = settings_.smooth.planned_mps3,
               grows = b / (2.0 * j);
  const double eased = std::max(0.0, way - b * b * b / (24.0 * j * j));
  return std::min(b * (std::sqrt(grows * grows + 2.0 * eased / b) - grows),
                  std::cbrt(std::max(0.0, way) * std::max(0.0, way) * j));  // v²/(2 b) + v b/(2 j); v √(v/j)
}

void TrafficModel::Leave(std::uint32_t id) {
  Agent& agent = agents_[id];
  const std::uint32_t trip = agent.trip + 1;
  const double driven = agent.driven_m;
  agent = Agent();
  if (full_) full_->Clear(id);
  agent.trip = trip;
  agent.driven_m = driven;
  if (id >= settings_.vehicles) return;  // a scenario's
  ++ended_;
  if (has_flows()) return;  // the next vehicle of a flow is another one
  agent.entry = DrawEntry(id, trip);
  waiting_.push_back(id);
}

// At each entry the first who waits there. Who is on it, or, where that lies in the middle of the network, on the way
// there, is looked for once for all.
void TrafficModel::Enter() {
  if (waiting_.empty()) return;
  present_.Clear();
  expected_.assign(graph().tracks().size(), 0);
  const bool among_others =
      std::any_of(waiting_.begin(), waiting_.end(), [&](std::uint32_t id) { return IsAmongOthers(agents_[id].entry); });
  const auto appear = [&](std::uint32_t id) {
    for (const Piece& piece : agents_[id].path) {
      if (map_->watched[piece.track]) present_.Add(piece.track, id);
    }
    if (!among_others) return;
    const double front = agents_[id].o_m + 0.5 * traits_[id].length_m, sight = SightOf(agents_[id]);
    for (const Stretch& stretch : stretches_[id]) {
      if (stretch.begin_m > front - 1.0 && stretch.begin_m - front < sight) expected_[stretch.track] = 1;
    }
  };
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if ((among_others || at_entry_[id] != 0) && agents_[id].on_road) appear(id);
  }
  std::vector<bool> tried(graph().tracks().size(), false);
  std::vector<std::uint32_t> left;
  for (const std::uint32_t id : waiting_) {
    const std::uint32_t entry = agents_[id].entry;
    if (tried[entry] || !TryEnter(id))
      left.push_back(id);
    else
      appear(id);
    tried[entry] = true;
  }
  waiting_ = std::move(left);
}

// Whether somebody may come to a track's beginning, or to that of one that parts from it.
bool TrafficModel::IsAmongOthers(std::uint32_t track) const {
  const auto partings = zones().PartingsOf(track);
  return !graph()[track].before.empty() ||
         std::any_of(partings.begin(), partings.end(),
                     [&](const lanes::Parting& part) { return !graph()[part.other].before.empty(); });
}

// Whether somebody is on his way to a track's beginning, or to that of one that parts from it, or is not clear of it
// yet on such a one.
bool TrafficModel::IsExpected(std::uint32_t track, double gap_m) const {
  if (IsAmongOthers(track) && expected_[track] != 0) return true;
  for (const lanes::Parting& part : zones().PartingsOf(track)) {
    if (expected_[part.other] != 0) return true;
    for (const std::uint32_t other : present_.Of(part.other)) {
      for (const Piece& piece : agents_[other].path) {
        if (piece.track == part.other &&
            agents_[other].o_m - 0.5 * traits_[other].length_m - piece.zero_m < part.other_out_m + gap_m)
          return true;
      }
    }
  }
  return false;
}

// The conflict zones at its beginning, up to the next place where it can stand: its own from now on. False where
// another one holds any of them.
bool TrafficModel::TakeFirstZones(std::uint32_t id) {
  Agent& agent = agents_[id];
  const double stand = traits_[id].length_m + kEntryStandingMargin_m;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > agent.granted_m + stand) break;
    for (const lanes::ZoneSide& part : zones().ConflictsOf(stretch.track)) {
      if (stretch.zero_m + part.in_m > agent.granted_m + stand) break;
      if (!book_.HoldersOf(part.zone, static_cast<std::size_t>(1 - part.side)).empty()) return false;
      agent.granted_m = std::max(agent.granted_m, stretch.zero_m + part.out_m);
    }
  }
  return true;
}

// With its rear bumper at the lane's beginning, at its own speed or at that of the car ahead, once the gap bears it.
bool TrafficModel::TryEnter(std::uint32_t id) {
  Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const double half = 0.5 * traits.length_m;
  const bool as_motors = settings_.enters == EnterRule::kFree;
  const double free_m = std::max(settings_.free_m, traits.length_m + kUntouched_m);  // of the lane, by that rule
  for (const Block& block : blocks_[agent.entry]) {
    if (block.span.rear_m < (as_motors ? free_m : traits.length_m + traits.idm.standing_gap_m) &&
        block.span.front_m > 0.0)
      return false;
  }
  const bool looks = settings_.driver != DriverKind::kMotors;  // beyond the lane that it enters
  if (looks && IsExpected(agent.entry, traits.idm.standing_gap_m)) return false;
  Agent entering = agent;
  entering.on_road = true;
  entering.o_m = half;
  entering.path = {{agent.entry, 0.0, 0.0, 0.0, 0.0, 1.0}};
  std::swap(agent, entering);
  const auto wait = [&] {
    std::swap(agent, entering);
    return false;
  };
  FindStretches(id, settings_.sight_m);
  const double limit = map_->plans[agent.entry].limit_mps * traits.speed_factor;
  double speed =
      kEnteringShare * std::min(Allowed(id, agents_[id].o_m).speed_mps * traits.speed_factor, traits.top_mps);
  if (looks && !TakeFirstZones(id)) return wait();
  speed = std::min(speed, AtMostForLine(id));
  if (people_) speed = std::min(speed, AtMostForPeople(id));
  if (speed < 0.0) return wait();
  // Nobody may stand where it enters, not even with its rear; agents have moved since they were last seen.
  for (const std::uint32_t other : present_.Of(agent.entry)) {
    for (const Piece& piece : agents_[other].path) {
      const double rear = agents_[other].o_m - 0.5 * traits_[other].length_m - piece.zero_m;
      if (piece.track == agent.entry && rear < (as_motors ? free_m : traits.length_m + 2.0 * traits.idm.standing_gap_m))
        return wait();
    }
  }
  const Ahead ahead = FindAhead(id);
  if (ahead.any) {
    const auto safe = [&](double v) {
      return ahead.gap_m > 2.0 * traits.idm.standing_gap_m &&
             ahead.gap_m >= traits.idm.standing_gap_m + v * traits.idm.time_gap_s &&
             driver::IdmAcceleration(traits.idm, v, limit, ahead.gap_m, ahead.speed_mps) > -kSpawnBraking_mps2;
    };
    if (!safe(speed)) speed = std::clamp(ahead.speed_mps, 0.0, speed);
    if (!as_motors && !safe(speed)) return wait();
  }
  agent.speed_mps = speed;
  missed_now_[id] = Follow(id);  // its front may be beyond a short lane already
  if (full_ && !PlaceFull(id)) return wait();
  if (agent.granted_m > 0.0) {
    agent.grants = {{agent.granted_m, next_grant_++, false}};
    HoldZones(id);
  }
  missed_ += missed_now_[id];
  return true;
}

}  // namespace rodeira::traffic

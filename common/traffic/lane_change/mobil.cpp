// SPDX-License-Identifier: Apache-2.0
// Whether a change to the lane beside is worth while, and safe.
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::int64_t kEvery_ns = 500'000'000;  // an agent thinks of another lane so often
constexpr std::int64_t kApart_ns = 37'000'000;   // one after the other
constexpr double kSlowest_mps = 3.0;
// With these the vehicle can stop before anything that the other lane leads to.
constexpr double kAnticipation_s = 2.0, kAnticipatedBraking_mps2 = 1.2;
constexpr double kAlongsideTolerance_m = 1e-6;  // a vehicle whose middle is no farther ahead or behind is alongside
constexpr double kSeeks_m = 350.0;  // so far before its lane parts from its route it looks for a gap by driving slower
constexpr double kSooner_m = 30.0;  // a lane that ends so much sooner is no choice …
constexpr double kEnding_mps2 = 1.0;  // … and one that ends, or parts from the route, is left for so much …
constexpr double kAtEnd_mps2 = 5.0, kFrom_m = 400.0;  // … growing to so much over the last part

}  // namespace

double TrafficModel::Limit_mps(std::uint32_t id, std::uint32_t track, double d_m) const {
  return std::min(LimitOn(track, d_m) * traits_[id].speed_factor, Cap_mps(id));
}

double TrafficModel::Following(std::uint32_t id, double limit_mps, bool any, double gap_m, double leader_mps) const {
  const driver::IdmSettings& idm = traits_[id].idm;
  const double v = agents_[id].speed_mps;
  return any && gap_m < settings_.sight_m ? driver::IdmAcceleration(idm, v, limit_mps, gap_m, leader_mps)
                                          : driver::IdmFreeAcceleration(idm, v, limit_mps);
}

// Who follows a rectangle whose middle and rear are there on a track: on it, or on those that lead to it.
Behind TrafficModel::FindBehind(std::uint32_t id, std::uint32_t track, double middle_m, double rear_m) const {
  Behind behind;
  bool here = false;  // who is farther back on the same branch is nobody's follower
  const auto consider = [&](std::int64_t other, std::uint32_t on, double d_m, double gap_m, double speed_mps) {
    here = true;
    if (gap_m < settings_.sight_m && (!behind.any || gap_m < behind.gap_m))
      behind = {gap_m, speed_mps, other, on, d_m, true};
  };
  struct At {
    std::uint32_t track;
    double middle_m, rear_m;
  };
  std::vector<At> open{{track, middle_m, rear_m}};
  for (std::size_t i = 0; i < open.size() && i < 32; ++i) {
    const At at = open[i];
    here = false;
    const auto all = occupants_.On(at.track);
    for (std::size_t k = all.size() - occupants_.Beyond(at.track, at.middle_m).size(); k-- > 0;) {
      if (all[k].id == id) continue;
      consider(all[k].id, at.track, all[k].front_m, at.rear_m - all[k].front_m, agents_[all[k].id].speed_mps);
      break;
    }
    for (const Block& block : blocks_[at.track]) {
      if (block.middle_m >= at.middle_m || block.span.right_m > kOnLaneOffset_m || block.span.left_m < -kOnLaneOffset_m)
        continue;
      consider(-1, at.track, block.span.front_m, at.rear_m - block.span.front_m, block.span.speed_mps);
    }
    if (here || at.rear_m - longest_half_m_ > std::min(settings_.sight_m, behind.any ? behind.gap_m : kNoBarrier_m))
      continue;
    for (const std::uint32_t before : graph()[at.track].before) {
      for (const lanes::Link& link : graph()[before].next) {
        const double further = graph()[before].length_m() - link.from_d_m;
        if (link.to == at.track) open.push_back({before, at.middle_m + further, at.rear_m + further});
      }
    }
  }
  return behind;
}

// What who follows does behind a leader.
double TrafficModel::FollowerDoes(const Behind& behind, bool any, double gap_m, double leader_mps) const {
  if (!behind.any) return 0.0;
  const double d = std::max(0.0, behind.d_m);
  if (behind.id >= 0) {
    const auto id = static_cast<std::uint32_t>(behind.id);
    return Following(id, Limit_mps(id, behind.track, d), any, gap_m, leader_mps);
  }
  const double limit = std::max(behind.speed_mps, LimitOn(behind.track, d));
  return any ? driver::IdmAcceleration(settings_.idm, behind.speed_mps, limit, gap_m, leader_mps)
             : driver::IdmFreeAcceleration(settings_.idm, behind.speed_mps, limit);
}

// A change to one side with what it would bring; nothing where it cannot be, or is not safe.
std::optional<Sideways> TrafficModel::Weigh(std::uint32_t id, int side, bool told) {
  Agent& agent = agents_[id];
  const auto piece = PieceBeside(id, side);
  if (!piece) return std::nullopt;
  const AgentTraits& traits = traits_[id];
  const double half = 0.5 * traits.length_m, rear = agent.o_m - half, to = piece->begin_m + piece->blend_m + half;
  if (passages_[id].any && passages_[id].line_m < to + half) return std::nullopt;
  if (!IsPlain(id, rear, to) || !MayCross(id, side, piece->begin_m, to - half)) return std::nullopt;
  const double beside_m = agent.o_m - piece->zero_m;
  for (const Occupant& other : occupants_.Beyond(piece->track, beside_m)) {
    if (other.middle_m() > beside_m + kAlongsideTolerance_m) break;
    if (other.id != id) return std::nullopt;
  }
  const Ahead own_ahead = ahead_[id];
  const double own_ends = LaneEnds(id);
  // The way on the other lane, looked along as the own one is.
  Stretches own = std::move(stretches_[id]);
  stretches_[id].clear();
  agent.path.push_back(*piece);
  FindStretches(id, SightOf(agent));
  const double v = agent.speed_mps,
               stops = piece->begin_m +
                       std::min(SightOf(agent), kAnticipation_s * v + v * v / (2.0 * kAnticipatedBraking_mps2));
  const bool plain = IsPlain(id, rear, std::max(to, stops));
  const double ends = LaneEnds(id);
  const Ahead ahead = plain ? FindAhead(id) : Ahead();
  agent.path.pop_back();
  Sideways way{*piece, side, 0.0, std::exchange(stretches_[id], std::move(own))};
  const int fewer = FewerChanges(id, piece->track);
  if (!plain || (!told && (ends < own_ends - kSooner_m || (fewer < 0 && ends < kNoBarrier_m)))) return std::nullopt;
  const Behind old_follower =
      FindBehind(id, agent.path.back().track, agent.o_m - agent.path.back().zero_m, rear - agent.path.back().zero_m);
  const Behind follower = FindBehind(id, piece->track, agent.o_m - piece->zero_m, rear - piece->zero_m);
  if (ahead.any && ahead.gap_m < traits.idm.standing_gap_m) return std::nullopt;
  if (follower.any && follower.gap_m < settings_.idm.standing_gap_m) return std::nullopt;
  const double at = piece->begin_m - piece->zero_m;
  driver::MobilCase mobil;
  mobil.own_mps2 = Following(id, Limit_mps(id, agent.path.back().track, piece->begin_m - agent.path.back().zero_m),
                             own_ahead.any, own_ahead.gap_m, own_ahead.speed_mps);
  mobil.own_then_mps2 = Following(id, Limit_mps(id, piece->track, at), ahead.any, ahead.gap_m, ahead.speed_mps);
  mobil.new_follower_mps2 =
      FollowerDoes(follower, ahead.any, follower.gap_m + traits.length_m + ahead.gap_m, ahead.speed_mps);
  mobil.new_follower_then_mps2 = FollowerDoes(follower, true, follower.gap_m, v);
  mobil.old_follower_mps2 = FollowerDoes(old_follower, true, old_follower.gap_m, v);
  mobil.old_follower_then_mps2 = FollowerDoes(
      old_follower, own_ahead.any, old_follower.gap_m + traits.length_m + own_ahead.gap_m, own_ahead.speed_mps);
  if (!driver::MobilIsSafe(settings_.lane_changes, mobil)) return std::nullopt;
  const bool keep = (side < 0) != graph()[piece->track].left_hand;
  const bool must = own_ends < ends - kSooner_m || (fewer > 0 && own_ends < kNoBarrier_m);
  way.surplus_mps2 =
      driver::MobilSurplus(settings_.lane_changes, mobil, keep) +
      (must ? std::lerp(kAtEnd_mps2, kEnding_mps2, std::clamp((own_ends - to) / kFrom_m, 0.0, 1.0)) : 0.0);
  return way;
}

// Whether it is its turn to think of another lane, and it is somewhere and drives so that it may.
bool TrafficModel::IsItsTurn(std::uint32_t id, std::int64_t step_ns) const {
  const std::int64_t now = time_ns_ + (id * kApart_ns) % kEvery_ns;
  return (now + step_ns) / kEvery_ns != now / kEvery_ns;
}

bool TrafficModel::ThinksOfLanes(std::uint32_t id, std::int64_t step_ns) const {
  return IsItsTurn(id, step_ns) && time_ns_ >= agents_[id].settled_ns && MayLeaveLane(id);
}

bool TrafficModel::MayLeaveLane(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  return agent.speed_mps >= kSlowest_mps && graph()[agent.path.back().track].junction < 0 && agent.grants.empty() &&
         !passages_[id].due;
}

// One after the other by their numbers: who has begun is seen by the next.
void TrafficModel::ChangeLanes(std::int64_t step_ns) {
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (beside_[id] == 0) continue;
    Agent& agent = agents_[id];
    if (!agent.on_road || agent.overtaking.active()) continue;
    if (agent.change.side != 0) {
      if (agent.o_m - 0.5 * traits_[id].length_m <= agent.change.to_m) continue;
      agent.change = {};
      agent.settled_ns = time_ns_ + kLaneChangeCooldown_ns;
    }
    if (agent.brake_mps2 > 0.0 || !HasBeside(id, agent.path.back().track)) continue;
    if (const int side = ToldSide(id); side != 0) {
      ChangeAsTold(id, side);
      continue;
    }
    if (!settings_.changes_lanes || !ThinksOfLanes(id, step_ns)) continue;
    std::optional<Sideways> best;
    for (const int side : {1, -1}) {
      auto way = Weigh(id, side);
      if (way && way->surplus_mps2 > 0.0 && (!best || way->surplus_mps2 > best->surplus_mps2)) best = std::move(way);
    }
    agent.seeks = !best && RouteEnds(id) - agent.o_m < kSeeks_m;
    if (best) BeginChange(id, std::move(*best));
  }
}

}  // namespace rodeira::traffic

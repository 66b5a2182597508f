// SPDX-License-Identifier: Apache-2.0
// Whether a change to the lane beside is worth while, and safe.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/driving/driver/mobil.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/lane_change/lane_changes.hpp"
#include "common/traffic/lane_change/turn.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kSlowest_mps = 3.0;

// With these the vehicle can stop before anything that the other lane leads to.
constexpr double kAnticipation_s = 2.0, kAnticipatedBraking_mps2 = 1.2;

constexpr double kAlongsideTolerance_m = 1e-6;  // a vehicle with a middle no farther ahead or behind is alongside
constexpr double kSooner_m = 30.0;              // a lane that ends so much sooner is no choice …
constexpr double kEnding_mps2 = 1.0;  // … and one that ends, or parts from the route, is left for so much …
constexpr double kAtEnd_mps2 = 5.0, kFrom_m = 400.0;  // … growing to so much over the last part
constexpr double kFartherOn_m = 15.0;                 // so much farther on the lane beside may be blocked, too
constexpr double kRoundLength_m = kMinTightChangeLength_m + 0.6;  // of a slow change round a standing vehicle
constexpr double kForcedSafe_mps2 = 3.0, kForcedFrom_m = 150.0;   // asked of others before an end or a standing body

}  // namespace

// A change to one side with what it would bring; nothing where it cannot be, or is not safe.
std::optional<LaneChangeOption> LaneChanges::Weigh(std::uint32_t id, int side, bool told) {
  Agent& agent = out_.agents[id];
  const auto end = in_.lanes_beside.EndAhead(id);
  const lanes::Track& track = in_.map.graph[agent.path.back().track];
  const auto beside = side > 0 ? track.left : track.right;
  const int fewer = beside ? in_.lanes_beside.FewerChanges(id, *beside) : 0;
  const auto round = in_.lanes_beside.GoesRound_m(id);
  const bool goes_round = round.has_value();
  const bool tight = goes_round || (fewer > 0 && in_.lanes_beside.ChangesSlowly(id));
  double tight_m = std::min(agent.path.back().zero_m + track.length_m(),
                            in_.passages[id].any ? in_.passages[id].line_m : kNoBarrier_m);
  if (goes_round) tight_m = std::min(tight_m, FrontOf(agent, in_.traits[id]) + kRoundLength_m);
  const auto piece =
      in_.lanes_beside.PieceBeside(id, side, end ? end->ends_m : kNoBarrier_m, tight ? tight_m : kNoBarrier_m);
  if (!piece) return std::nullopt;
  const AgentTraits& traits = in_.traits[id];
  const bool slowly = piece->blend_m < kMinLaneChangeLength_m;
  const double half = 0.5 * traits.length_m, rear = agent.o_m - half, ends_m = piece->begin_m + piece->blend_m,
               to = ends_m + (slowly ? 0.0 : half);
  const double tightest = slowly ? kTightestTightChange_1pm : kTightestLaneChange_1pm;
  if (in_.passages[id].any && in_.passages[id].line_m < (slowly ? ends_m : to + half)) return std::nullopt;
  if (!in_.lanes_beside.IsPlain(id, rear, to, tightest) || !in_.lanes_beside.MayCross(id, side, piece->begin_m, ends_m))
    return std::nullopt;
  const double beside_m = agent.o_m - piece->zero_m;
  for (const Occupant& other : out_.occupants.Beyond(piece->track, beside_m)) {
    if (other.middle_m() > beside_m + kAlongsideTolerance_m) break;
    if (other.id != id) return std::nullopt;
  }
  const Leader own_ahead = out_.ahead[id];
  const double own_ends = in_.lanes_beside.LaneEnds(id);
  // The way on the other lane, looked along as the own one is.
  RouteSegments own = std::move(out_.stretches[id]);
  out_.stretches[id].clear();
  agent.path.push_back(*piece);
  out_.ways.FindRouteSegments(id, out_.ways.SightOf(agent));
  const double v = agent.speed_mps,
               stops = piece->begin_m + std::min(out_.ways.SightOf(agent),
                                                 kAnticipation_s * v + v * v / (2.0 * kAnticipatedBraking_mps2));
  const double ends = in_.lanes_beside.LaneEnds(id), blocked = in_.lanes_beside.Blocked_m(id);
  const bool leaves_end = end && own_ends < ends - kSooner_m;
  const bool plain = leaves_end ? in_.lanes_beside.IsPlain(id, rear, to) && in_.lanes_beside.IsFree(id, to, stops)
                                : in_.lanes_beside.IsPlain(id, rear, std::max(to, stops), tightest);
  const Leader ahead = plain ? in_.neighbours.FindLeader(id) : Leader();
  const LaneChange none =
      std::exchange(agent.change, {side, piece->blend_from_m, piece->blend_from_m + piece->blend_m});
  const bool is_kept = own_ahead.any &&
                       std::fabs(own_ahead.speed_mps) < (goes_round ? kSlowest_mps : kStandingLeader_mps) &&
                       !PassesBeside(in_.map.graph, agent, traits, own_ahead);
  const bool is_stopped = in_.lanes_beside.IsKept(id, own, to - FrontOf(agent, traits));
  agent.change = none;
  agent.path.pop_back();
  LaneChangeOption way{*piece, side, 0.0, std::exchange(out_.stretches[id], std::move(own))};
  if (!plain || is_kept || is_stopped || (!told && (ends < own_ends - kSooner_m || (fewer < 0 && ends < kNoBarrier_m))))
    return std::nullopt;
  const Follower old_follower = in_.neighbours.FindFollower(
      id, agent.path.back().track, agent.o_m - agent.path.back().zero_m, rear - agent.path.back().zero_m);
  const Follower follower =
      in_.neighbours.FindFollower(id, piece->track, agent.o_m - piece->zero_m, rear - piece->zero_m);
  if (ahead.any && ahead.gap_m < traits.idm.min_gap_m) return std::nullopt;
  if (!told && blocked < (goes_round ? *round - FrontOf(agent, traits) + kFartherOn_m : kNoBarrier_m))
    return std::nullopt;
  if (follower.any && follower.gap_m < in_.settings.idm.min_gap_m) return std::nullopt;
  const double at = piece->begin_m - piece->zero_m;
  driver::MobilCase mobil;
  mobil.own_mps2 = in_.following.Following(
      id, in_.limits.Limit_mps(id, agent.path.back().track, piece->begin_m - agent.path.back().zero_m), own_ahead.any,
      own_ahead.gap_m, own_ahead.speed_mps);
  mobil.own_then_mps2 =
      in_.following.Following(id, in_.limits.Limit_mps(id, piece->track, at), ahead.any, ahead.gap_m, ahead.speed_mps);
  mobil.new_follower_mps2 =
      in_.following.FollowerDoes(follower, ahead.any, follower.gap_m + traits.length_m + ahead.gap_m, ahead.speed_mps);
  mobil.new_follower_then_mps2 = in_.following.FollowerDoes(follower, true, follower.gap_m, v);
  mobil.old_follower_mps2 = in_.following.FollowerDoes(old_follower, true, old_follower.gap_m, v);
  mobil.old_follower_then_mps2 = in_.following.FollowerDoes(
      old_follower, own_ahead.any, old_follower.gap_m + traits.length_m + own_ahead.gap_m, own_ahead.speed_mps);
  driver::MobilSettings settings = in_.settings.lane_changes;
  if (leaves_end || goes_round) {
    const double room = (leaves_end ? end->waits_m : *round - kRoundLength_m) - FrontOf(agent, traits);
    const double near = std::clamp(1.0 - room / kForcedFrom_m, 0.0, 1.0);
    settings.safe_mps2 = std::max(settings.safe_mps2, std::lerp(settings.safe_mps2, kForcedSafe_mps2, near));
  }
  if (!driver::MobilIsSafe(settings, mobil)) return std::nullopt;
  const bool keep = (side < 0) != in_.map.graph[piece->track].left_hand;
  const bool must = own_ends < ends - kSooner_m || (fewer > 0 && own_ends < kNoBarrier_m);
  way.surplus_mps2 = driver::MobilSurplus(in_.settings.lane_changes, mobil, keep) +
                     (goes_round ? kAtEnd_mps2
                      : must     ? std::lerp(kAtEnd_mps2, kEnding_mps2, std::clamp((own_ends - to) / kFrom_m, 0.0, 1.0))
                                 : 0.0);
  return way;
}

bool LaneChanges::ThinksOfLanes(std::uint32_t id, std::int64_t step_ns, bool even_slowly) const {
  return IsItsTurn(in_.time_ns, id, step_ns) && in_.time_ns >= out_.agents[id].settled_ns &&
         MayLeaveLane(id, even_slowly);
}

bool LaneChanges::NeedsSlowChange(std::uint32_t id) const {
  return in_.lanes_beside.ChangesSlowly(id) && in_.lanes_beside.RouteEnds(id) < kNoBarrier_m;
}

bool LaneChanges::GoesRound(std::uint32_t id) const { return in_.lanes_beside.GoesRound_m(id).has_value(); }

bool LaneChanges::MayLeaveLane(std::uint32_t id, bool even_slowly) const {
  const Agent& agent = out_.agents[id];
  return (even_slowly || agent.speed_mps >= kSlowest_mps || in_.lanes_beside.EndAhead(id) || NeedsSlowChange(id) ||
          GoesRound(id)) &&
         in_.map.graph[agent.path.back().track].junction < 0 && agent.grants.empty() && !in_.passages[id].due;
}

}  // namespace rodeira::traffic

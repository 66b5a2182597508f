// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/overtaking/overtaking_drive.hpp"

#include <algorithm>
#include <cmath>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kTooNear_s = 1.5;                // oncoming: with less to spare it falls back, if that is sooner done
constexpr double kSlower_mps = 4.0;               // than the one to be passed, while it falls back …
constexpr double kFallsBack_mps2 = 2.5;           // … and its braking
constexpr double kMinPassed_mps = 5.0;            // a slower one is not fallen back behind
constexpr double kMaxFollowerBraking_mps2 = 2.0;  // braking of the follower when the overtaking vehicle goes back …
constexpr double kMaxOwnBraking_mps2 = 2.5;       // … and its own
constexpr double kNever_s = 1e9;
constexpr double kLastPart = 0.2;  // of the path back, on the own side (PlanPass)

// The shortest path back at this speed.
double ShortestBack_m(double aside_m, double speed_mps) {
  return std::max(kMinTightChangeLength_m, UrgentLaneChangeTime_s(aside_m) * speed_mps);
}

}  // namespace

// Whether its own lane is free beside it: no vehicle would have to brake hard, before it or, where it goes back before
// a vehicle, behind it.
bool OvertakingDrive::MayGoBack(std::uint32_t id, bool behind) const {
  const Agent& agent = out_.agents[id];
  const Piece& last = agent.path.back();
  const double half = 0.5 * in_.traits[id].length_m, v = agent.speed_mps, gap = in_.traits[id].idm.min_gap_m;
  if (agent.o_m + half < last.blend_from_m + last.blend_m) return false;  // still on its path out
  const Follower follower =
      in_.neighbours.FindFollower(id, last.track, agent.o_m - last.zero_m, agent.o_m - half - last.zero_m);
  if (follower.any && (follower.gap_m < gap || (!behind && in_.following.FollowerDoes(follower, true, follower.gap_m,
                                                                                      v) < -kMaxFollowerBraking_mps2)))
    return false;
  const Leader ahead = in_.neighbours.FindLeader(id);
  if (!ahead.any) return true;
  // A vehicle that is no agent may stop at any time: the path back then ends behind it.
  if (behind && ahead.body >= 0 && ahead.gap_m + StopsAfter_m(ahead.speed_mps) < ShortestBack_m(last.aside_m, v) + gap)
    return false;
  return ahead.gap_m >= gap &&
         in_.following.Following(id, in_.limits.Limit_mps(id, last.track, agent.o_m - last.zero_m), true, ahead.gap_m,
                                 ahead.speed_mps) >= -kMaxOwnBraking_mps2;
}

void OvertakingDrive::GoBack(std::uint32_t id, bool behind) {
  Agent& agent = out_.agents[id];
  const Piece last = agent.path.back();
  const double front = agent.o_m + 0.5 * in_.traits[id].length_m;
  const PathFrame at = FrameAt(in_.map.graph, agent.path, front);
  const PassCase pass = out_.overtaking_start.CaseOf(id, {}, 0.0, last.aside_m, front);
  Piece piece{last.track, last.zero_m, front, at.offset_m, at.slope};
  piece.blend_from_m = front;
  piece.blend_m = behind && agent.overtaking.passed_body >= 0
                      ? ShortestBack_m(last.aside_m, agent.speed_mps)
                      : std::max(kMinLaneChangeLength_m, pass.back_s * agent.speed_mps);
  agent.path.push_back(piece);
  agent.overtaking.back = true;
  agent.overtaking.to_m = front + piece.blend_m;
}

// Whether the one passed is no agent, slow, and may stop before the place where the path out is clear of it.
bool OvertakingDrive::MayStopInWay(std::uint32_t id, const Leader& passed) const {
  const Overtaking& way = out_.agents[id].overtaking;
  const double front = FrontOf(out_.agents[id], in_.traits[id]);
  return passed.body >= 0 && !way.back && !way.gives_up && std::fabs(passed.speed_mps) < kSlowBody_mps &&
         front < way.clear_m && front + passed.gap_m + StopsAfter_m(passed.speed_mps) < way.clear_m + kPassingBy_m;
}

// It goes on, falls back or goes back to its lane, by what all others do now.
void OvertakingDrive::DriveOvertaking(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  Overtaking& way = agent.overtaking;
  const double length = in_.traits[id].length_m, front = agent.o_m + 0.5 * length, v = std::max(1.0, agent.speed_mps);
  const auto passed = in_.neighbours.FindOvertaken(id);
  const bool is_past = !passed || passed->gap_m + 0.5 * (passed->length_m + length) < 0.0;
  if (!way.back && (is_past || way.gives_up) && MayGoBack(id, !is_past)) GoBack(id, !is_past);
  if (passed && MayStopInWay(id, *passed)) {
    if (const auto rest = out_.overtaking_start.ShorterRest(id, *passed)) {
      agent.path.push_back(rest->piece);
      way.clear_m = rest->clear_m;
    }
  }
  if (way.back) {
    way.back_s = agent.brake_mps2 > 0.0
                     ? kNever_s
                     : std::max(0.0, way.to_m + length - front - kLastPart * agent.path.back().blend_m) / v;
    return;
  }
  const double aside = agent.path.back().aside_m,
               top = std::max(v, out_.overtaking_start.TopSpeed(id, front, std::max(front, way.to_m)));
  PassCase pass =
      out_.overtaking_start.CaseOf(id, passed.value_or(Leader{-1e9}), top, aside, std::max(front, way.to_m));
  pass.to_clear_m = std::max(0.0, way.clear_m - front);
  pass.gains_mps2 = std::max(0.1, pass.gains_mps2);
  const PassPlan on = PlanPass(pass);
  const Oncoming oncoming = in_.oncoming.FindOncoming(id);
  const auto spare = [&](double time_s, double way_m) {
    return (oncoming.from_m - front - way_m) / oncoming.speed_mps - time_s;
  };
  way.to_m = front + on.way_m, way.back_s = agent.brake_mps2 > 0.0 ? kNever_s : on.time_s;
  if (!passed || is_past || (passed->speed_mps < kMinPassed_mps && passed->gap_m < 0.0)) return;
  // Behind a vehicle that is no agent, and slow, there may be no room for the way back when it stops.
  if (passed->body >= 0 && passed->speed_mps < kSlowBody_mps) {
    way.gives_up = false;
    return;
  }
  // Falling back: slower than that one until it is behind, and back.
  const double slower = std::max(0.0, passed->speed_mps - kSlower_mps),
               least = std::max(1.0, passed->speed_mps - slower);
  const double behind_m = std::max(0.0, in_.traits[id].idm.min_gap_m - passed->gap_m);
  const double still_out = std::max(0.0, agent.path.back().blend_from_m + agent.path.back().blend_m - front) / v;
  const double time =
      std::max(still_out, std::max(0.0, v - slower) / kFallsBack_mps2 + behind_m / least) + pass.back_s + length / v;
  const double far = std::max(pass.passed_mps, 0.5 * (v + pass.passed_mps)) * time;
  const bool late = spare(on.time_s, on.way_m) < kTooNear_s || way.to_m > way.legal_m;
  if (late && spare(time, far) > spare(on.time_s, on.way_m)) way.gives_up = true;
  if (way.gives_up) way.to_m = front + far, way.back_s = agent.brake_mps2 > 0.0 ? kNever_s : time;
}

double OvertakingDrive::WantedBeside(std::uint32_t id, double wanted_mps2) const {
  const Agent& agent = out_.agents[id];
  if (in_.is_overtaken[id] != 0 && agent.speed_mps > kMinPassed_mps) wanted_mps2 = std::min(wanted_mps2, 0.0);
  const Overtaking& way = agent.overtaking;
  if (way.active() && way.back) {  // its path is for the speed that it had, or the least one
    const Piece& last = agent.path.back();
    const double slow = way.passed_body >= 0 && last.blend_m <= kMinLaneChangeLength_m
                            ? TightChange_mps(last.offset_m, last.blend_m)
                            : 0.0;
    return std::min(wanted_mps2, std::max(0.0, (slow - agent.speed_mps) / in_.settings.tracking_s));
  }
  if (!way.active() || (!way.gives_up && way.passed_body < 0)) return wanted_mps2;
  const auto passed = in_.neighbours.FindOvertaken(id);
  if (passed && MayStopInWay(id, *passed)) {  // it keeps room for a shorter rest of its path out
    const double front = FrontOf(agent, in_.traits[id]);
    const double stands = front + passed->gap_m + StopsAfter_m(passed->speed_mps),
                 soonest = front + agent.speed_mps * agent.speed_mps / (2.0 * kRoomBraking_mps2);
    return std::min(wanted_mps2, in_.following.StopAt(id, std::max(stands - kRoomToGoRound_m, soonest)));
  }
  if (!way.gives_up) return wanted_mps2;
  if (!passed || passed->gap_m > in_.traits[id].idm.min_gap_m) return wanted_mps2;
  const double slower = std::max(0.0, passed->speed_mps - kSlower_mps);
  return std::min(wanted_mps2, std::clamp((slower - agent.speed_mps) / in_.settings.tracking_s, -kFallsBack_mps2, 0.5));
}

// One after the other by their numbers: one that has begun is seen by the next.
void OvertakingDrive::Overtake(std::int64_t step_ns) {
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    if (in_.passes[id] == 0) continue;
    Agent& agent = out_.agents[id];
    if (!agent.on_road) continue;
    if (!agent.overtaking.active()) {
      if (agent.brake_mps2 == 0.0 &&
          (agent.told_past ? in_.lane_changes.MayLeaveLane(id)
                           : in_.settings.overtaking.allowed &&
                                 in_.lane_changes.ThinksOfLanes(
                                     id, step_ns, out_.overtaking_start.PassesStanding_m(id).has_value())))
        out_.overtaking_start.ThinkOfOvertaking(id);
      continue;
    }
    if (agent.overtaking.back && agent.o_m - 0.5 * in_.traits[id].length_m > agent.overtaking.to_m) {
      agent.overtaking = {};
      agent.settled_ns = in_.time_ns + kLaneChangeCooldown_ns;
      continue;
    }
    DriveOvertaking(id);
  }
}

}  // namespace rodeira::traffic

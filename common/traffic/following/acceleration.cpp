// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/following/acceleration.hpp"

#include <algorithm>
#include <cmath>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/pedestrians/stopping.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kComes_mps = -0.1,
                 kEvades_mps2 =
                     1.0;  // oncoming on the own lane; braking from which on it is braked for as hard as can be
constexpr double kSeekingShare = 0.75,
                 kSeeking_mps2 =
                     1.0;  // of the planned speed, while a gap in the lane beside is looked for; its braking

constexpr double kTightSeeking_mps = 3.5;  // the same where only slow vehicles change lanes
constexpr double kLaneEndShare = 1.25;     // of comfortable braking, before the end of the lane

}  // namespace

// The acceleration that keeps to the plan, and comes back to it. Where the plan soon asks for less than the driver does
// now, the driver begins with that half of the time earlier that coming to it smoothly takes: as much below the plan
// before that place as behind it, and is never faster than it.
double Acceleration::WantedByPlan(std::uint32_t id, const driver::SpeedPlan::Allowed& here) const {
  const Agent& agent = in_.agents[id];
  const double v = agent.speed_mps, share = in_.traits[id].speed_factor,
               twice_jerk = 2.0 * in_.settings.smooth.planned_mps3;
  const double wanted = here.slope_1ps * share * v + (here.speed_mps * share - v) / in_.settings.tracking_s;
  double way = 0.0, there = 0.0, slows = -in_.settings.speed.braking_mps2;
  for (int turn = 0; turn < 2; ++turn) {  // as far as the hardest braking of a plan asks, then as far as this one
    if (agent.desired_mps2 <= slows) return wanted;
    way = v * (agent.desired_mps2 - slows) / twice_jerk;
    const driver::SpeedPlan::Allowed soon = in_.limits.Allowed(id, agent.o_m + way);
    there = soon.speed_mps * share;
    slows = soon.slope_1ps * share * std::min(v, there);
  }
  if (agent.desired_mps2 <= slows) return wanted;
  const double line = std::sqrt(std::max(0.0, there * there - 2.0 * slows * way));  // that of then, as it would be here
  return std::min(wanted, slows + (line - v) / in_.settings.tracking_s);
}

// While it looks for a gap in the lane beside.
double Acceleration::SeekingSpeed(std::uint32_t id, double planned_mps) const {
  const double speed = kSeekingShare * planned_mps;
  return in_.lanes_beside.ChangesSlowly(id) ? std::min(speed, kTightSeeking_mps) : speed;
}

double Acceleration::Wanted(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const AgentTraits& traits = in_.traits[id];
  const double v = agent.speed_mps;
  const driver::SpeedPlan::Allowed allowed = in_.limits.Allowed(id, agent.o_m);
  const double planned = allowed.speed_mps * traits.speed_factor;
  const double limit = in_.limits.Desired_mps(id);
  const driver::IdmSettings idm = in_.overtaking_start.IdmOf(id);
  const double free = idm.acceleration_mps2 > traits.idm.acceleration_mps2
                          ? std::min(idm.acceleration_mps2, (limit - v) / in_.settings.tracking_s)
                          : driver::IdmFreeAcceleration(idm, v, limit);
  double wanted = std::min(free, WantedByPlan(id, allowed));
  if (planned > Cap_mps(in_.agents[id], in_.traits[id]))
    wanted = std::min(wanted, (Cap_mps(in_.agents[id], in_.traits[id]) - v) / in_.settings.tracking_s);
  if (agent.seeks)
    wanted = std::min(wanted, std::max(-kSeeking_mps2, (SeekingSpeed(id, planned) - v) / in_.settings.tracking_s));
  if (const Piece& last = agent.path.back(); agent.change.side != 0 && last.blend_m < kMinLaneChangeLength_m)
    wanted = std::min(wanted, (TightChange_mps(last.offset_m, last.blend_m) - v) / in_.settings.tracking_s);
  if (const Piece& last = agent.path.back();
      agent.overtaking.active() && (last.blend_m < kMinLaneChangeLength_m || agent.overtaking.passed_body >= 0) &&
      agent.o_m < last.blend_from_m + last.blend_m)
    wanted = std::min(wanted, (TightChange_mps(last.offset_m, last.blend_m) - v) / in_.settings.tracking_s);
  const Leader& ahead = in_.ahead[id];
  if (ahead.any && ahead.gap_m < in_.settings.sight_m) {
    const bool eased = ahead.id >= 0 && ahead.id == agent.eased_for;
    const double behind = eased ? in_.following.FollowComing(id, static_cast<std::uint32_t>(ahead.id), ahead.gap_m)
                                : driver::IdmAcceleration(idm, v, limit, ahead.gap_m, ahead.speed_mps);
    const bool against =
        ahead.id < 0 && ahead.speed_mps < kComes_mps && behind < -kEvades_mps2;  // that one may not stop
    wanted = std::min(wanted, against ? -idm.max_deceleration_mps2 : behind);
  }
  if (in_.passages[id].any && in_.passages[id].due)
    wanted = std::min(wanted, in_.following.StopAt(id, in_.passages[id].line_m));
  if (const auto end = in_.lanes_beside.EndAhead(id))
    wanted = std::min(wanted, in_.following.StopAt(id, end->waits_m, kLaneEndShare));
  auto stands = in_.lanes_beside.GoesRound_m(id);
  if (!stands) stands = in_.overtaking_start.PassesStanding_m(id, kSlowBody_mps);
  if (stands && agent.change.side == 0) {
    const double soonest = FrontOf(agent, traits) + v * v / (2.0 * kRoomBraking_mps2);
    wanted = std::min(wanted, in_.following.StopAt(id, std::max(*stands - kRoomToGoRound_m, soonest)));
  }
  if (const auto waits = in_.lanes_beside.WaitsBeside_m(id))
    wanted = std::min(wanted, in_.following.StopAt(id, *waits, kLaneEndShare));
  if (in_.bars[id] < kNoBarrier_m) wanted = std::min(wanted, in_.following.StopAt(id, in_.bars[id], kYieldingShare));
  wanted = std::min(wanted, in_.leaves[id]);
  wanted = std::min({wanted, in_.oncoming.WantedForOvertaker(id, limit), in_.lane_changes.WantedCourteous(id, limit)});
  wanted = std::clamp(in_.overtaking.WantedBeside(id, wanted), -idm.max_deceleration_mps2, idm.acceleration_mps2);
  return agent.brake_mps2 > 0.0 ? std::min(wanted, -agent.brake_mps2) : wanted;
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/overtaking/overtaking_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "common/driving/driver/idm.hpp"
#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/overtaking/haste.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHeldUp_mps2 = 0.3;   // so much less than on a free road
constexpr double kGain_mps = 4.0;      // so much faster than the one passed at least …
constexpr double kToldGain_mps = 1.0;  // … and one that is commanded to
constexpr double kToldNear_s = 4.0;    // it begins no farther behind its leader than this, and its minimum gap
constexpr double kOvertakingClearance_m = 0.45;  // lateral, between the two vehicles
constexpr double kMaxAside = 0.97;               // of the way to the other lane's middle that it may need
constexpr double kMinGain_mps2 = 0.15;
constexpr double kRoom_s = 1.0;             // and its minimum gap, behind the leader of that one
constexpr double kBrakes_mps2 = 2.0;        // there
constexpr double kLegalMargin_m = 10.0;     // beyond the return for which marks and signs are checked
constexpr double kInitialLength_m = 150.0;  // first guess of the overtaking distance
constexpr int kGuesses = 4;
constexpr double kSlowest_mps = 1.0;         // at which it is taken to come nearer
constexpr double kStandingClear_m = 1.0;     // before one that stands its path is clear of it
constexpr double kFarFromJunction_m = 40.0;  // beyond one that stands: it does not wait at a line

bool IsSlowBody(const Leader& other) { return other.body >= 0 && std::fabs(other.speed_mps) < kSlowBody_mps; }
bool Stands(const Leader& other) { return other.body >= 0 && std::fabs(other.speed_mps) < kStandingLeader_mps; }

// From the front bumper to where the rear of one that may stop will be at the least.
double StopsAt_m(const Leader& other) { return other.gap_m + (Stands(other) ? 0.0 : StopsAfter_m(other.speed_mps)); }

double GainFor(const Agent& agent) { return agent.told_past ? kToldGain_mps : kGain_mps; }

}  // namespace

driver::IdmSettings OvertakingStart::IdmOf(std::uint32_t id) const {
  driver::IdmSettings idm = in_.traits[id].idm;
  const Overtaking& way = out_.agents[id].overtaking;
  if (!way.active() || way.back || way.gives_up) return idm;
  if (out_.agents[id].o_m + 0.5 * in_.traits[id].length_m < way.clear_m)
    idm.time_gap_s = std::min(idm.time_gap_s, kBackGap_s);
  else
    idm.acceleration_mps2 *= kHaste;
  return idm;
}

bool OvertakingStart::IsHeldUp(std::uint32_t id) const {
  const Leader& ahead = in_.ahead[id];
  if (!ahead.any || ahead.gap_m > in_.settings.sight_m || ahead.speed_mps < -0.1) return false;
  if (ahead.id >= 0) {
    const auto other = static_cast<std::size_t>(ahead.id);
    if (out_.agents[other].change.side != 0 || out_.agents[other].overtaking.active() || in_.is_overtaken[other] != 0)
      return false;
  }
  const std::uint32_t track = out_.agents[id].path.back().track;
  const double limit = in_.limits.Limit_mps(id, track, out_.agents[id].o_m - out_.agents[id].path.back().zero_m);
  if (limit < ahead.speed_mps + GainFor(out_.agents[id])) return false;
  if (out_.agents[id].told_past)
    return ahead.gap_m < in_.traits[id].idm.min_gap_m + kToldNear_s * out_.agents[id].speed_mps;
  if (Stands(ahead) && PassesStanding_m(id)) return true;
  return in_.following.Following(id, limit, true, ahead.gap_m, ahead.speed_mps) <
         in_.following.Following(id, limit, false, 0.0, 0.0) - kHeldUp_mps2;
}

// Sideways, from the middle of its lane, until it is clear of the one that it passes.
double OvertakingStart::Needs_m(std::uint32_t id, const Leader& passed, int side) const {
  return 0.5 * in_.traits[id].width_m + kOvertakingClearance_m + (side > 0 ? passed.left_m : -passed.right_m);
}

// Slowly, a path out to be clear of one that stands, or may soon, is as short as that one's nearness makes it.
void OvertakingStart::Tighten(std::uint32_t id, Piece& piece) const {
  const Leader& passed = in_.ahead[id];
  if (!IsSlowBody(passed)) return;
  const double share = Needs_m(id, passed, piece.aside_m > 0.0 ? 1 : -1) / std::fabs(piece.aside_m),
               tight = (StopsAt_m(passed) - kStandingClear_m) / QuinticShareAt(share);
  if (tight < piece.blend_m && tight >= kMinTightChangeLength_m &&
      out_.agents[id].speed_mps < TightChange_mps(piece.aside_m, tight))
    piece.blend_m = tight;
}

std::optional<OvertakingStart::RestOut> OvertakingStart::ShorterRest(std::uint32_t id, const Leader& passed) const {
  const Agent& agent = out_.agents[id];
  const Piece& last = agent.path.back();
  const double front = FrontOf(agent, in_.traits[id]), aside = std::fabs(last.aside_m);
  const PathFrame at = FrameAt(in_.map.graph, agent.path, front);
  const double to_go = std::fabs(at.offset_m - last.aside_m),
               may_lack = aside - Needs_m(id, passed, agent.overtaking.side);
  const double clear = StopsAt_m(passed) - kStandingClear_m;
  if (may_lack <= 0.0 || to_go <= may_lack || clear <= 0.0) return std::nullopt;
  RestOut rest{{last.track, last.zero_m, front, at.offset_m - last.aside_m, at.slope}, front + clear};
  rest.piece.blend_from_m = front;
  rest.piece.aside_m = last.aside_m;
  rest.piece.blend_m = clear / QuinticShareAt(1.0 - may_lack / to_go);
  if (rest.piece.blend_m < kMinTightChangeLength_m * std::sqrt(to_go / aside) ||
      agent.speed_mps >= TightChange_mps(to_go, rest.piece.blend_m))
    return std::nullopt;
  return rest;
}

std::optional<double> OvertakingStart::PassesStanding_m(std::uint32_t id, double below_mps) const {
  const Agent& agent = out_.agents[id];
  if (!in_.settings.overtaking.allowed || agent.overtaking.active()) return std::nullopt;
  const auto body = in_.lanes_beside.BlockedBy(id, below_mps);
  if (!body) return std::nullopt;  // hardly ever is there one: the track, in far memory, is looked at behind this
  const lanes::Track& track = in_.map.graph[agent.path.back().track];
  if (track.left || track.right) return std::nullopt;
  const double front = FrontOf(agent, in_.traits[id]), stands = front + body->gap_m, clear = stands + body->length_m;
  const auto piece = PieceOut(id, 0.0);
  if (!piece || !in_.lanes_beside.IsPlain(id, front, clear + kFarFromJunction_m)) return std::nullopt;
  const int side = piece->aside_m > 0.0 ? 1 : -1;
  if (!in_.lanes_beside.MayCross(id, side, front, clear) ||
      Needs_m(id, *body, side) > kMaxAside * std::fabs(piece->aside_m))
    return std::nullopt;
  return stands;
}

// Whether there is room for it between the one passed and the leader of that one.
bool OvertakingStart::HasRoomBefore(std::uint32_t id, const Overtaking& way, const PassPlan& plan, double top_mps) {
  Agent& agent = out_.agents[id];
  const Leader& passed = in_.ahead[id];
  const AgentTraits& traits = in_.traits[id];
  const Overtaking own = std::exchange(agent.overtaking, way);
  agent.overtaking.clear_m = -kNoBarrier_m;
  const Leader next = in_.neighbours.FindLeader(id);
  agent.overtaking = own;
  if (!next.any) return true;
  const double v = std::max(0.0, passed.speed_mps);
  const double there = next.gap_m - passed.gap_m - passed.length_m + (next.speed_mps - v) * plan.gaining_s -
                       traits.idm.min_gap_m - kBackGap_s * v - traits.length_m;
  if (there < traits.idm.min_gap_m + kRoom_s * plan.speed_mps) return false;
  return driver::IdmAcceleration(traits.idm, plan.speed_mps, top_mps, there, next.speed_mps) >= -kBrakes_mps2;
}

// The path out, and what is to be known of it; nothing where it cannot be, or is not safe. The stretches reach as far
// as an overtaker looks.
std::optional<Piece> OvertakingStart::WeighOvertaking(std::uint32_t id, Overtaking& way) {
  const AgentTraits& traits = in_.traits[id];
  const Leader& passed = in_.ahead[id];
  const double front = out_.agents[id].o_m + 0.5 * traits.length_m, v = out_.agents[id].speed_mps,
               fast = std::max(v, kSlowest_mps), clear_m = Stands(passed) ? kStandingClear_m : traits.idm.min_gap_m;
  const Oncoming oncoming = in_.oncoming.FindOncoming(id);
  if (oncoming.own_way) return std::nullopt;
  std::optional<Piece> piece;
  PassPlan plan;
  double to = front + kInitialLength_m, top = 0.0;
  for (int guess = 0; guess < kGuesses; ++guess) {
    top = TopSpeed(id, front, to);
    if (top < std::max(v, passed.speed_mps + GainFor(out_.agents[id]))) return std::nullopt;
    piece = PieceOut(id, top);
    if (!piece) return std::nullopt;
    way.side = piece->aside_m > 0.0 ? 1 : -1;
    const double needs = Needs_m(id, passed, way.side);
    if (needs > kMaxAside * std::fabs(piece->aside_m)) return std::nullopt;
    Tighten(id, *piece);
    way.clear_m = front + piece->blend_m * QuinticShareAt(needs / std::fabs(piece->aside_m));
    PassCase pass = CaseOf(id, passed, top, piece->aside_m, to);
    pass.to_clear_m = way.clear_m - front;
    if (piece->blend_m < kMinLaneChangeLength_m)  // from a walking pace on it gains speed on its way out
      pass.speed_mps = std::max(v, 0.5 * TightChange_mps(piece->aside_m, piece->blend_m));
    if (pass.gains_mps2 < kMinGain_mps2 || passed.gap_m - (fast - passed.speed_mps) * pass.to_clear_m / fast < clear_m)
      return std::nullopt;
    if (IsSlowBody(passed) && !Stands(passed) && StopsAt_m(passed) < pass.to_clear_m + kPassingBy_m)
      return std::nullopt;
    plan = PlanPass(pass);
    if (oncoming.from_m - front - plan.way_m < oncoming.speed_mps * (plan.time_s + in_.settings.overtaking.margin_s))
      return std::nullopt;
    const double before = std::exchange(to, front + plan.way_m);
    if (guess > 0 && to <= before) break;
  }
  way.passed = passed.id, way.passed_body = passed.body;
  way.legal_m = to + kLegalMargin_m;
  way.to_m = to, way.back_s = plan.time_s;
  if (!MayOvertake(id, way.legal_m, piece->aside_m) || !HasRoomBefore(id, way, plan, top)) return std::nullopt;
  return piece;
}

void OvertakingStart::ThinkOfOvertaking(std::uint32_t id) {
  Agent& agent = out_.agents[id];
  if (in_.map.opposites[agent.path.back().track] < 0 || agent.change.side != 0 || in_.is_overtaken[id] != 0 ||
      !IsHeldUp(id))
    return;
  RouteSegments own = std::move(out_.stretches[id]);
  out_.stretches[id].clear();
  out_.ways.FindRouteSegments(id, in_.settings.overtaking.sight_m);
  Overtaking way;
  const auto piece = WeighOvertaking(id, way);
  out_.stretches[id] = std::move(own);
  if (!piece) return;
  agent.overtaking = way;
  out_.any_overtaking = true;
  agent.told_past = false;
  agent.path.push_back(*piece);
  out_.observation.ShowToOncoming(id);
}

}  // namespace rodeira::traffic

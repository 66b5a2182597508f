// SPDX-License-Identifier: Apache-2.0
// Whether to overtake on the lane of oncoming traffic: is there somebody who holds it up, does the law allow it, and is
// there way enough?
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kHeldUp_mps2 = 0.3;   // so much less than on a free road
constexpr double kGain_mps = 4.0;      // so much faster than who is passed at least …
constexpr double kToldGain_mps = 1.0;  // … and who is told to
constexpr double kToldNear_s = 4.0;    // he begins no farther behind who is ahead than this, and his standing gap
constexpr double kOvertakingClearance_m = 0.45;  // lateral, between the two vehicles
constexpr double kMostAside = 0.97;              // of the way to the other lane's middle that it may need
constexpr double kFasterOut_mps = 4.5;           // than now it is at most at the end of its path out
constexpr double kHaste = 1.4;                   // of its usual acceleration
constexpr double kOfHaste = 0.8;                 // that it counts on, of what its engine gives there
constexpr double kLeastGain_mps2 = 0.15;
constexpr double kBackGap_s = 0.7;                  // and its standing gap, before who was passed when it goes back
constexpr double kRoom_s = 1.0;                     // and its standing gap, behind who drives before that one
constexpr double kBrakes_mps2 = 2.0;                // there
constexpr double kLegalMargin_m = 10.0;             // beyond the return for which marks and signs are checked
constexpr double kOvertakingSamplingStep_m = 10.0;  // between two places at which the way is checked
constexpr double kUneven_m = 0.25;                  // of the other lane's middle against a line along the own one
constexpr double kInitialLength_m = 150.0;          // first guess of the overtaking distance
constexpr int kGuesses = 4;

double GainFor(const Agent& agent) { return agent.told_past ? kToldGain_mps : kGain_mps; }

}  // namespace

// While it overtakes it is in more of a hurry, and comes nearer to who is before it.
driver::IdmSettings TrafficModel::IdmOf(std::uint32_t id) const {
  driver::IdmSettings idm = traits_[id].idm;
  const Overtaking& way = agents_[id].overtaking;
  if (!way.active() || way.back || way.gives_up) return idm;
  if (agents_[id].o_m + 0.5 * traits_[id].length_m < way.clear_m)
    idm.time_gap_s = std::min(idm.time_gap_s, kBackGap_s);
  else
    idm.acceleration_mps2 *= kHaste;
  return idm;
}

bool TrafficModel::IsHeldUp(std::uint32_t id) const {
  const Ahead& ahead = ahead_[id];
  if (!ahead.any || ahead.gap_m > settings_.sight_m || ahead.speed_mps < -0.1) return false;
  if (ahead.id >= 0) {
    const auto other = static_cast<std::size_t>(ahead.id);
    if (agents_[other].change.side != 0 || agents_[other].overtaking.active() || is_overtaken_[other] != 0)
      return false;
  }
  const std::uint32_t track = agents_[id].path.back().track;
  const double limit = Limit_mps(id, track, agents_[id].o_m - agents_[id].path.back().zero_m);
  if (limit < ahead.speed_mps + GainFor(agents_[id])) return false;
  if (agents_[id].told_past) return ahead.gap_m < traits_[id].idm.standing_gap_m + kToldNear_s * agents_[id].speed_mps;
  return Following(id, limit, true, ahead.gap_m, ahead.speed_mps) <
         Following(id, limit, false, 0.0, 0.0) - kHeldUp_mps2;
}

// The least that it may, and wants to, drive between two odometers.
double TrafficModel::TopSpeed(std::uint32_t id, double from_m, double to_m) const {
  double top = Cap_mps(id);
  for (double at = from_m; at < to_m + kOvertakingSamplingStep_m; at += kOvertakingSamplingStep_m)
    top = std::min(top, AllowedAt(id, std::min(at, to_m)));
  return top;
}

// To the middle of the lane of oncoming traffic, from its front bumper on.
std::optional<Piece> TrafficModel::PieceOut(std::uint32_t id, double top_mps) const {
  const Agent& agent = agents_[id];
  const Piece& last = agent.path.back();
  const std::int64_t opposite = map_->opposites[last.track];
  const double begin = agent.o_m + 0.5 * traits_[id].length_m, d = begin - last.zero_m;
  const bool settled = (last.offset_m == 0.0 && last.slope == 0.0) || begin > last.blend_from_m + last.blend_m;
  if (opposite < 0 || !settled || last.aside_m != 0.0 || d > graph()[last.track].length_m()) return std::nullopt;
  const auto there = static_cast<std::uint32_t>(opposite);
  const lanes::CurvePoint at = graph()[last.track].curve.At(d),
                          to = graph()[there].curve.At(graph().Across(last.track, d, there));
  Piece piece{last.track, last.zero_m, begin};
  piece.blend_from_m = begin;
  piece.aside_m = (to.p_W - at.p_W).head<2>().dot(at.left_W());
  piece.offset_m = -piece.aside_m;
  const double time = LaneChangeTime_s(piece.aside_m);
  piece.blend_m = std::max(kMinLaneChangeLength_m,
                           time * std::min(std::max(agent.speed_mps, top_mps), agent.speed_mps + kFasterOut_mps));
  return piece;
}

// What is still to be done from now on behind, or beside, who is passed.
PassCase TrafficModel::CaseOf(std::uint32_t id, const Ahead& passed, double top_mps, double aside_m,
                              double to_m) const {
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const double front = agent.o_m + 0.5 * traits.length_m;
  double steepest = 0.0;
  for (const Stretch& stretch : stretches_[id]) {
    for (double at = std::max(front, stretch.begin_m); at < std::min(to_m, stretch.end_m);
         at += kOvertakingSamplingStep_m) {
      steepest = std::max(steepest, graph()[stretch.track].curve.At(at - stretch.zero_m).grade);
    }
  }
  const PlanarCar& car = PlanarCarOfBody(traits.body);
  const double wants = kHaste * traits.idm.acceleration_mps2;
  PassCase pass;
  pass.speed_mps = agent.speed_mps, pass.passed_mps = std::max(0.0, passed.speed_mps), pass.top_mps = top_mps;
  pass.gains_mps2 = wants;
  for (const double v : {agent.speed_mps, 0.5 * (agent.speed_mps + top_mps), top_mps}) {
    pass.gains_mps2 = std::min(pass.gains_mps2, AccelerationOf(car, DrivingFor(car, v, wants, steepest), v, steepest));
  }
  pass.gains_mps2 *= kOfHaste;
  pass.relative_m = std::max(
      0.0, passed.gap_m + passed.length_m + traits.idm.standing_gap_m + kBackGap_s * pass.passed_mps + traits.length_m);
  pass.back_s = LaneChangeTime_s(aside_m), pass.back_least_m = kMinLaneChangeLength_m;
  pass.length_m = traits.length_m;
  return pass;
}

// Whether marks, signs and both lanes let it drive on the other side as far as there.
bool TrafficModel::MayOvertake(std::uint32_t id, double to_m, double aside_m) const {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  if (!IsPlain(id, rear, to_m + traits_[id].length_m) || !MayCross(id, aside_m > 0.0 ? 1 : -1, front, to_m))
    return false;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < rear) continue;
    const std::int64_t opposite = map_->opposites[stretch.track];
    const double low = std::max(rear, stretch.begin_m) - stretch.zero_m,
                 high = std::min(to_m, stretch.end_m) - stretch.zero_m;
    if (opposite < 0 || !map_->no_overtaking.Allows(stretch.track, std::max(low, front - stretch.zero_m), high))
      return false;
    const auto track = static_cast<std::uint32_t>(opposite);
    const lanes::Curve& curve = graph()[track].curve;
    const double from = graph().Across(stretch.track, high, track), until = graph().Across(stretch.track, low, track);
    for (const lanes::ZoneSide& part : zones().Of(track)) {
      if (part.in_m < until && part.out_m > from) return false;
    }
    for (double d = low; d < high + kOvertakingSamplingStep_m; d += kOvertakingSamplingStep_m) {
      const double there = graph().Across(stretch.track, std::min(d, high), track);
      const lanes::CurvePoint at = graph()[stretch.track].curve.At(std::min(d, high));
      const double offset = (curve.At(there).p_W - at.p_W).head<2>().dot(at.left_W());
      if (curve.WidthAt(there) < kMinLaneChangeWidth_m || std::fabs(offset - aside_m) > kUneven_m) return false;
    }
  }
  return true;
}

// Whether there is room for it between who is passed and who drives before that one.
bool TrafficModel::HasRoomBefore(std::uint32_t id, const Overtaking& way, const PassPlan& plan, double top_mps) {
  Agent& agent = agents_[id];
  const Ahead& passed = ahead_[id];
  const AgentTraits& traits = traits_[id];
  const Overtaking own = std::exchange(agent.overtaking, way);
  agent.overtaking.clear_m = -kNoBarrier_m;
  const Ahead next = FindAhead(id);
  agent.overtaking = own;
  if (!next.any) return true;
  const double v = std::max(0.0, passed.speed_mps);
  const double there = next.gap_m - passed.gap_m - passed.length_m + (next.speed_mps - v) * plan.gaining_s -
                       traits.idm.standing_gap_m - kBackGap_s * v - traits.length_m;
  if (there < traits.idm.standing_gap_m + kRoom_s * plan.speed_mps) return false;
  return driver::IdmAcceleration(traits.idm, plan.speed_mps, top_mps, there, next.speed_mps) >= -kBrakes_mps2;
}

// The path out, and what is to be known of it; nothing where it cannot be, or is not safe. The stretches reach as far
// as who overtakes looks.
std::optional<Piece> TrafficModel::WeighOvertaking(std::uint32_t id, Overtaking& way) {
  const AgentTraits& traits = traits_[id];
  const Ahead& passed = ahead_[id];
  const double front = agents_[id].o_m + 0.5 * traits.length_m, v = agents_[id].speed_mps;
  const Oncoming oncoming = FindOncoming(id);
  if (oncoming.own_way) return std::nullopt;
  std::optional<Piece> piece;
  PassPlan plan;
  double to = front + kInitialLength_m, top = 0.0;
  for (int guess = 0; guess < kGuesses; ++guess) {
    top = TopSpeed(id, front, to);
    if (top < std::max(v, passed.speed_mps + GainFor(agents_[id]))) return std::nullopt;
    piece = PieceOut(id, top);
    if (!piece) return std::nullopt;
    way.side = piece->aside_m > 0.0 ? 1 : -1;
    const double needs =
        0.5 * traits.width_m + kOvertakingClearance_m + (way.side > 0 ? passed.left_m : -passed.right_m);
    if (needs > kMostAside * std::fabs(piece->aside_m)) return std::nullopt;
    way.clear_m = front + piece->blend_m * QuinticShareAt(needs / std::fabs(piece->aside_m));
    PassCase pass = CaseOf(id, passed, top, piece->aside_m, to);
    pass.to_clear_m = way.clear_m - front;
    if (pass.gains_mps2 < kLeastGain_mps2 ||
        passed.gap_m - (v - passed.speed_mps) * pass.to_clear_m / v < traits.idm.standing_gap_m)
      return std::nullopt;
    plan = PlanPass(pass);
    if (oncoming.from_m - front - plan.way_m < oncoming.speed_mps * (plan.time_s + settings_.overtaking.margin_s))
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

void TrafficModel::ThinkOfOvertaking(std::uint32_t id) {
  Agent& agent = agents_[id];
  if (map_->opposites[agent.path.back().track] < 0 || agent.change.side != 0 || is_overtaken_[id] != 0 || !IsHeldUp(id))
    return;
  Stretches own = std::move(stretches_[id]);
  stretches_[id].clear();
  FindStretches(id, settings_.overtaking.sight_m);
  Overtaking way;
  const auto piece = WeighOvertaking(id, way);
  stretches_[id] = std::move(own);
  if (!piece) return;
  agent.overtaking = way;
  any_overtaking_ = true;
  agent.told_past = false;
  agent.path.push_back(*piece);
  FaceOncoming(id);
}

}  // namespace rodeira::traffic

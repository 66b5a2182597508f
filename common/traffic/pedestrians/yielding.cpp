// SPDX-License-Identifier: Apache-2.0
// What agents and people on foot make of each other at crossings: people step out when everybody who comes can stop
// comfortably, stands, or has passed; who can stop comfortably does so for who waits, and everybody for who has stepped
// out.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kCrosswalkStopDistance_m = 1.0;  // from a stopped front to the crossing
constexpr double kBrakeReaction_s = 0.5;          // until the brakes act
constexpr double kMaxPedestrianWait_s = 20.0;     // pedestrians let a vehicle go that has waited for them this long …
constexpr double kMinClearAhead_m = 3.0;          // … and has this much space ahead
constexpr double kDrivers_mps2 = 2.0;             // braking that is expected of other vehicles …
constexpr double kDriversReact_s = 1.0;           // … and when it begins
constexpr double kEntering = 0.6;                 // share of the comfortable braking that an entering car may need
constexpr double kShareOfRed = 0.8;               // in which people step out, where red is shorter than they need
constexpr std::size_t kMaxTracksAhead = 64;

double NeedsToStop(double speed_mps, double braking_mps2) {
  return speed_mps * speed_mps / (2.0 * braking_mps2) + kBrakeReaction_s * speed_mps;
}

}  // namespace

double TrafficModel::StoppingWay(std::uint32_t id) const {
  const double v = agents_[id].speed_mps;
  return v * v / (2.0 * kYieldingShare * traits_[id].idm.braking_mps2) + 2.0 * kBrakeReaction_s * v +
         2.0 * kCrosswalkStopDistance_m;
}

bool TrafficModel::NearCrossing(std::uint32_t track, double low_m, double high_m) const {
  if (!people_) return false;
  const auto& here = people_->OfTrack(track);
  return std::any_of(here.begin(), here.end(), [&](const Pedestrians::OnTrack& on) {
    const lanes::FootPass& pass = people_->crossings()[on.crossing].passes[on.pass];
    return pass.in_m - kCrosswalkStopDistance_m < high_m && pass.out_m > low_m;
  });
}

// Green for those on foot; without a light of theirs red for those who come over every lane that has one, as long as
// they need.
bool TrafficModel::LightsLetGo(const lanes::FootCrossing& crossing) const {
  if (crossing.light >= 0) return IsGreen(crossing.light);
  for (const lanes::FootPass& pass : crossing.passes) {
    if (pass.light < 0) continue;
    const auto& times = *map_->network->controllers()[static_cast<std::size_t>(pass.light)].times;
    const double red_s = times.cycle_s - times.green_s - times.amber_s - times.red_amber_s;
    const double needed_s = std::min(crossing.length_m / settings_.pedestrians->slowest_mps, kShareOfRed * red_s);
    for (double ahead_s = 0.0; ahead_s < needed_s + 1.0; ahead_s += 1.0) {
      const auto then_ns = time_ns_ + std::llround(1e9 * std::min(ahead_s, needed_s));
      if (network::ColourAt(times, then_ns) != network::LightColour::kRed) return false;
    }
  }
  return true;
}

// Who comes to which crossing, and who is on one.
void TrafficModel::CarsAtCrossings() {
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    const Agent& agent = agents_[id];
    if (!agent.on_road) continue;
    const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half,
                 v = agent.speed_mps;
    for (const Stretch& stretch : stretches_[id]) {
      for (const Pedestrians::OnTrack& on : people_->OfTrack(stretch.track)) {
        const lanes::FootPass& pass = people_->crossings()[on.crossing].passes[on.pass];
        const double in = stretch.zero_m + pass.in_m, out = stretch.zero_m + pass.out_m,
                     line = in - kCrosswalkStopDistance_m;
        if (out <= rear || out < stretch.begin_m || in > stretch.end_m) continue;
        AtCrossing& at = at_crossings_[on.crossing];
        if (front > in) {
          at.held = true;
          at.blocked = at.blocked || v < kStandstill_mps;
          continue;
        }
        const bool yields =
            yielding_[id].crossing == on.crossing + 1 && v * v <= 2.0 * traits_[id].idm.hardest_mps2 * (in - front);
        const bool able = yields || v < kStandstill_mps ||
                          NeedsToStop(v, kYieldingShare * traits_[id].idm.braking_mps2) <= line - front;
        to_crossings_.push_back({id, on.crossing, on.pass, std::max(front, line), able});
      }
    }
  }
  // Each must stop behind those before it, also behind one who comes in from beside, whom it does not follow yet.
  const auto gap = [&](const ToCrossing& to) { return to.line_m - agents_[to.id].o_m - 0.5 * traits_[to.id].length_m; };
  std::sort(to_crossings_.begin(), to_crossings_.end(), [&](const ToCrossing& a, const ToCrossing& b) {
    return std::tuple(a.crossing, a.pass, gap(a), a.id) < std::tuple(b.crossing, b.pass, gap(b), b.id);
  });
  double queue_m = 0.0;
  for (std::size_t i = 0; i < to_crossings_.size(); ++i) {
    ToCrossing& to = to_crossings_[i];
    if (i == 0 || to.crossing != to_crossings_[i - 1].crossing || to.pass != to_crossings_[i - 1].pass) queue_m = 0.0;
    const double v = agents_[to.id].speed_mps,
                 needed = NeedsToStop(v, kYieldingShare * traits_[to.id].idm.braking_mps2);
    if (!to.able ||
        (v >= kStandstill_mps && yielding_[to.id].crossing != to.crossing + 1 && needed > gap(to) - queue_m))
      at_crossings_[to.crossing].held = true;
    queue_m += traits_[to.id].length_m + settings_.idm.standing_gap_m;
  }
}

// Vehicles that are no agents, on every way that they may take.
void TrafficModel::OthersAtCrossings() {
  struct At {
    std::uint32_t track;
    double ahead_m;  // from its front to the track's beginning
  };
  for (std::uint32_t track = 0; track < blocks_.size(); ++track) {
    for (const Block& block : blocks_[track]) {
      if (block.span.left_m < -kOnLaneOffset_m || block.span.right_m > kOnLaneOffset_m) continue;
      const double v = std::fabs(block.span.speed_mps), length = block.span.front_m - block.span.rear_m;
      const double stops_m = v * v / (2.0 * kDrivers_mps2) + kDriversReact_s * v;
      const bool along = block.span.speed_mps >= 0.0;
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < kMaxTracksAhead; ++i) {
        const At at = open[i];
        for (const Pedestrians::OnTrack& on : people_->OfTrack(at.track)) {
          const lanes::FootPass& pass = people_->crossings()[on.crossing].passes[on.pass];
          const double gap = at.ahead_m + pass.in_m;              // from its front
          const double back = -length - at.ahead_m - pass.out_m;  // from its rear, to what lies behind it
          const bool there = gap < 0.0 && back < 0.0;
          if (there) at_crossings_[on.crossing].blocked = at_crossings_[on.crossing].blocked || v < kStandstill_mps;
          if (there || (v >= kStandstill_mps && (along ? gap >= 0.0 && gap < stops_m : back >= 0.0 && back < stops_m)))
            at_crossings_[on.crossing].held = true;
        }
        const double end = at.ahead_m + graph()[at.track].length_m();
        if (!along || end > stops_m) continue;
        for (const lanes::Link& link : graph()[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

void TrafficModel::Yield(double dt_s) {
  std::vector<Yielding> now(agents_.size());
  for (const ToCrossing& to : to_crossings_) {
    const AtCrossing& at = at_crossings_[to.crossing];
    const double waited = yielding_[to.id].waited_s;
    const bool awaited =
        people_->Waits(to.crossing) && at.go && !at.blocked && to.able && waited < kMaxPedestrianWait_s;
    if (!awaited && !people_->IsUsed(to.crossing, to.pass)) continue;
    if (to.line_m >= bars_[to.id]) continue;
    bars_[to.id] = to.line_m;
    now[to.id] = {to.crossing + 1, agents_[to.id].speed_mps < kStandstill_mps ? waited + dt_s : 0.0};
  }
  for (const ToCrossing& to : to_crossings_) {  // who is let go by those on foot has waited long until it drives
    const Yielding& before = yielding_[to.id];
    if (now[to.id].crossing == 0 && before.crossing == to.crossing + 1 && before.waited_s >= kMaxPedestrianWait_s)
      now[to.id] = before;
  }
  yielding_ = std::move(now);
}

void TrafficModel::LookAtPeople(double dt_s) {
  std::fill(bars_.begin(), bars_.end(), kNoBarrier_m);
  at_crossings_.assign(people_->crossings().size(), {});
  to_crossings_.clear();
  CarsAtCrossings();
  OthersAtCrossings();
  for (const ToCrossing& to : to_crossings_) {
    const Yielding& yielding = yielding_[to.id];
    if (yielding.crossing == to.crossing + 1 && yielding.waited_s >= kMaxPedestrianWait_s &&
        ahead_[to.id].gap_m > kMinClearAhead_m)
      at_crossings_[to.crossing].tired = true;
  }
  for (std::uint32_t c = 0; c < at_crossings_.size(); ++c) {
    AtCrossing& at = at_crossings_[c];
    at.go = people_->Waits(c) && LightsLetGo(people_->crossings()[c]);
    if (at.go && !at.held && !at.tired) people_->LetGo(c);
  }
  Yield(dt_s);
}

// The speed from which an entering car can stop before the first crossing at which somebody walks or waits; below 0
// where it would stand on one.
double TrafficModel::AtMostForPeople(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const double front = agent.o_m + 0.5 * traits_[id].length_m, rear = front - traits_[id].length_m;
  double speed = Agent::kNoCap_mps;
  for (const Stretch& stretch : stretches_[id]) {
    for (const Pedestrians::OnTrack& on : people_->OfTrack(stretch.track)) {
      if (!people_->IsUsed(on.crossing, on.pass) && !people_->Waits(on.crossing)) continue;
      const lanes::FootPass& pass = people_->crossings()[on.crossing].passes[on.pass];
      if (stretch.zero_m + pass.out_m <= rear) continue;
      const double way = stretch.zero_m + pass.in_m - kCrosswalkStopDistance_m - front;
      if (way < 0.0) return -1.0;
      const double b = kEntering * traits_[id].idm.braking_mps2;
      speed = std::min(speed, b * (std::sqrt(kBrakeReaction_s * kBrakeReaction_s + 2.0 * way / b) -
                                   kBrakeReaction_s));  // v²/(2b) + v·reaction = way
    }
  }
  return speed;
}

base::Status TrafficModel::CheckCall(std::string_view road, double s_m) const {
  if (!people_)
    return base::WrongInput(
        "the traffic has no people on foot; 'pedestrians' in its settings was expected (its 'per_hour' may be 0)");
  return people_->Nearest(*map_->network, road, s_m) ? base::Status()
                                                     : base::WrongInput(WithoutCrossing(*map_->network, road));
}

base::Status TrafficModel::CallPedestrian(std::string_view road, double s_m, bool from_left) {
  if (const auto status = CheckCall(road, s_m); !status) return status;
  const auto crossing = people_->Nearest(*map_->network, road, s_m);
  const network::Road& at = map_->network->roads()[people_->crossings()[*crossing].road];
  const double heading =
      at.axis().Evaluate(std::clamp(people_->crossings()[*crossing].s_m, 0.0, at.length_m())).heading_rad;
  const Eigen::Vector2d left(-std::sin(heading), std::cos(heading));
  const bool begins_right = people_->crossings()[*crossing].across_W.dot(left) > 0.0;  // u = 0 lies on the road's right
  people_->Come(*crossing, begins_right == from_left ? 1 : 0);
  return {};
}

void TrafficModel::HitPedestrian(std::uint32_t id) {
  if (people_) people_->Hit(id);
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/pedestrians/crosswalks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/traffic/pedestrians/stopping.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMaxPedestrianWait_s = 20.0;  // pedestrians let a vehicle go that has waited for them this long …
constexpr double kMinClearAhead_m = 3.0;       // … and has this much space ahead
constexpr double kDrivers_mps2 = 2.0;          // braking that is expected of other vehicles …
constexpr double kDriversReact_s = 1.0;        // … and when it begins
constexpr double kEntering = 0.6;              // share of the comfortable braking that an entering car may need
constexpr double kShareOfRed = 0.8;            // in which people step out, where red is shorter than they need
constexpr std::size_t kMaxTracksAhead = 64;

double NeedsToStop(double speed_mps, double braking_mps2) {
  return speed_mps * speed_mps / (2.0 * braking_mps2) + kBrakeReaction_s * speed_mps;
}

}  // namespace

// Green for pedestrians; without a light of theirs red for vehicles over every lane that has one, as long as
// they need.
bool Crosswalks::LightsLetGo(const lanes::FootCrossing& crossing) const {
  if (crossing.light >= 0) return in_.signals.IsGreen(crossing.light);
  for (const lanes::FootPass& pass : crossing.passes) {
    if (pass.light < 0) continue;
    const auto& times = *in_.map.network->controllers()[static_cast<std::size_t>(pass.light)].times;
    const double red_s = times.cycle_s - times.green_s - times.amber_s - times.red_amber_s;
    const double needed_s = std::min(crossing.length_m / in_.settings.pedestrians->slowest_mps, kShareOfRed * red_s);
    for (double ahead_s = 0.0; ahead_s < needed_s + 1.0; ahead_s += 1.0) {
      const auto then_ns = in_.time_ns + std::llround(1e9 * std::min(ahead_s, needed_s));
      if (in_.signals.ColourAt(pass.light, then_ns) != network::LightColour::kRed) return false;
    }
  }
  return true;
}

// Which vehicles come to which crossing, and which are on one.
void Crosswalks::CarsAtCrossings() {
  for (std::uint32_t id = 0; id < in_.agents.size(); ++id) {
    const Agent& agent = in_.agents[id];
    if (!agent.on_road) continue;
    const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half, rear = agent.o_m - half,
                 v = agent.speed_mps;
    for (const RouteSegment& stretch : in_.stretches[id]) {
      for (const Pedestrians::OnTrack& on : out_.people->OfTrack(stretch.track)) {
        const lanes::FootPass& pass = out_.people->crossings()[on.crossing].passes[on.pass];
        const double in = stretch.zero_m + pass.in_m, out = stretch.zero_m + pass.out_m,
                     line = in - kCrosswalkStopDistance_m;
        if (out <= rear || out < stretch.begin_m || in > stretch.end_m) continue;
        AtCrossing& at = out_.at_crossings[on.crossing];
        if (front > in) {
          at.held = true;
          at.blocked = at.blocked || v < kStandstill_mps;
          continue;
        }
        const bool yields = out_.yielding[id].crossing == on.crossing + 1 &&
                            v * v <= 2.0 * in_.traits[id].idm.max_deceleration_mps2 * (in - front);
        const bool able = yields || v < kStandstill_mps ||
                          NeedsToStop(v, kYieldingShare * in_.traits[id].idm.braking_mps2) <= line - front;
        out_.to_crossings.push_back({id, on.crossing, on.pass, std::max(front, line), able});
      }
    }
  }
  // Each must stop behind those before it, also behind one that comes in from beside and that it does not follow yet.
  const auto gap = [&](const ToCrossing& to) {
    return to.line_m - in_.agents[to.id].o_m - 0.5 * in_.traits[to.id].length_m;
  };
  std::sort(out_.to_crossings.begin(), out_.to_crossings.end(), [&](const ToCrossing& a, const ToCrossing& b) {
    return std::tuple(a.crossing, a.pass, gap(a), a.id) < std::tuple(b.crossing, b.pass, gap(b), b.id);
  });
  double queue_m = 0.0;
  for (std::size_t i = 0; i < out_.to_crossings.size(); ++i) {
    ToCrossing& to = out_.to_crossings[i];
    if (i == 0 || to.crossing != out_.to_crossings[i - 1].crossing || to.pass != out_.to_crossings[i - 1].pass)
      queue_m = 0.0;
    const double v = in_.agents[to.id].speed_mps,
                 needed = NeedsToStop(v, kYieldingShare * in_.traits[to.id].idm.braking_mps2);
    if (!to.able ||
        (v >= kStandstill_mps && out_.yielding[to.id].crossing != to.crossing + 1 && needed > gap(to) - queue_m))
      out_.at_crossings[to.crossing].held = true;
    queue_m += in_.traits[to.id].length_m + in_.settings.idm.min_gap_m;
  }
}

// Vehicles that are no agents, on every way that they may take.
void Crosswalks::OthersAtCrossings() {
  struct At {
    std::uint32_t track;
    double ahead_m;  // from its front to the track's beginning
  };
  for (std::uint32_t track = 0; track < in_.blocks.size(); ++track) {
    for (const Block& block : in_.blocks[track]) {
      if (block.span.left_m < -kOnLaneOffset_m || block.span.right_m > kOnLaneOffset_m) continue;
      const double v = std::fabs(block.span.speed_mps), length = block.span.front_m - block.span.rear_m;
      const double stops_m = v * v / (2.0 * kDrivers_mps2) + kDriversReact_s * v;
      const bool along = block.span.speed_mps >= 0.0;
      std::vector<At> open{{track, -block.span.front_m}};
      for (std::size_t i = 0; i < open.size() && i < kMaxTracksAhead; ++i) {
        const At at = open[i];
        for (const Pedestrians::OnTrack& on : out_.people->OfTrack(at.track)) {
          const lanes::FootPass& pass = out_.people->crossings()[on.crossing].passes[on.pass];
          const double gap = at.ahead_m + pass.in_m;              // from its front
          const double back = -length - at.ahead_m - pass.out_m;  // from its rear, to what lies behind it
          const bool there = gap < 0.0 && back < 0.0;
          if (there)
            out_.at_crossings[on.crossing].blocked = out_.at_crossings[on.crossing].blocked || v < kStandstill_mps;
          if (there || (v >= kStandstill_mps && (along ? gap >= 0.0 && gap < stops_m : back >= 0.0 && back < stops_m)))
            out_.at_crossings[on.crossing].held = true;
        }
        const double end = at.ahead_m + in_.map.graph[at.track].length_m();
        if (!along || end > stops_m) continue;
        for (const lanes::Link& link : in_.map.graph[at.track].next) open.push_back({link.to, end - link.from_d_m});
      }
    }
  }
}

void Crosswalks::Yield(double dt_s) {
  std::vector<Yielding> now(in_.agents.size());
  for (const ToCrossing& to : out_.to_crossings) {
    const AtCrossing& at = out_.at_crossings[to.crossing];
    const double waited = out_.yielding[to.id].waited_s;
    const bool awaited =
        out_.people->Waits(to.crossing) && at.go && !at.blocked && to.able && waited < kMaxPedestrianWait_s;
    if (!awaited && !out_.people->IsUsed(to.crossing, to.pass)) continue;
    if (to.line_m >= out_.bars[to.id]) continue;
    out_.bars[to.id] = to.line_m;
    now[to.id] = {to.crossing + 1, in_.agents[to.id].speed_mps < kStandstill_mps ? waited + dt_s : 0.0};
  }
  for (const ToCrossing& to : out_.to_crossings) {  // a vehicle that pedestrians let go has waited long until it drives
    const Yielding& before = out_.yielding[to.id];
    if (now[to.id].crossing == 0 && before.crossing == to.crossing + 1 && before.waited_s >= kMaxPedestrianWait_s)
      now[to.id] = before;
  }
  std::copy(now.begin(), now.end(), out_.yielding.begin());
}

void Crosswalks::LookAtPeople(double dt_s) {
  std::fill(out_.bars.begin(), out_.bars.end(), kNoBarrier_m);
  out_.at_crossings.assign(out_.people->crossings().size(), {});
  out_.to_crossings.clear();
  CarsAtCrossings();
  OthersAtCrossings();
  for (const ToCrossing& to : out_.to_crossings) {
    const Yielding& yielding = out_.yielding[to.id];
    if (yielding.crossing == to.crossing + 1 && yielding.waited_s >= kMaxPedestrianWait_s &&
        in_.ahead[to.id].gap_m > kMinClearAhead_m)
      out_.at_crossings[to.crossing].tired = true;
  }
  for (std::uint32_t c = 0; c < out_.at_crossings.size(); ++c) {
    AtCrossing& at = out_.at_crossings[c];
    at.go = out_.people->Waits(c) && LightsLetGo(out_.people->crossings()[c]);
    if (at.go && !at.held && !at.tired) out_.people->LetGo(c);
  }
  Yield(dt_s);
}

double Crosswalks::AtMostForPeople(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const double front = agent.o_m + 0.5 * in_.traits[id].length_m, rear = front - in_.traits[id].length_m;
  double speed = Agent::kNoCap_mps;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    for (const Pedestrians::OnTrack& on : out_.people->OfTrack(stretch.track)) {
      if (!out_.people->IsUsed(on.crossing, on.pass) && !out_.people->Waits(on.crossing)) continue;
      const lanes::FootPass& pass = out_.people->crossings()[on.crossing].passes[on.pass];
      if (stretch.zero_m + pass.out_m <= rear) continue;
      const double way = stretch.zero_m + pass.in_m - kCrosswalkStopDistance_m - front;
      if (way < 0.0) return -1.0;
      const double b = kEntering * in_.traits[id].idm.braking_mps2;
      speed = std::min(speed, b * (std::sqrt(kBrakeReaction_s * kBrakeReaction_s + 2.0 * way / b) -
                                   kBrakeReaction_s));  // v²/(2b) + v·reaction = way
    }
  }
  return speed;
}

base::Status Crosswalks::CheckSpawnPedestrian(std::string_view road, double s_m) const {
  if (!out_.people)
    return base::WrongInput(
        "traffic.no_pedestrians",
        "the traffic has no people on foot; 'pedestrians' in its settings was expected (its 'per_hour' may be 0)");
  return out_.people->Nearest(*in_.map.network, road, s_m)
             ? base::Status()
             : base::WrongInput("traffic.no_crossing", WithoutCrossing(*in_.map.network, road));
}

base::Status Crosswalks::SpawnPedestrian(std::string_view road, double s_m, bool from_left) {
  if (const auto status = CheckSpawnPedestrian(road, s_m); !status) return status;
  const auto crossing = out_.people->Nearest(*in_.map.network, road, s_m);
  const network::Road& at = in_.map.network->roads()[out_.people->crossings()[*crossing].road];
  const double heading =
      at.axis().Evaluate(std::clamp(out_.people->crossings()[*crossing].s_m, 0.0, at.length_m())).heading_rad;
  const Eigen::Vector2d left(-std::sin(heading), std::cos(heading));
  const bool begins_right =
      out_.people->crossings()[*crossing].across_W.dot(left) > 0.0;  // u = 0 lies on the road's right
  out_.people->Come(*crossing, begins_right == from_left ? 1 : 0);
  return {};
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// The path to the other lane, and what overtaking needs.
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/overtaking/haste.hpp"
#include "common/traffic/overtaking/overtaking_start.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFasterOut_mps = 4.5;              // than now it is at most at the end of its path out
constexpr double kOfHaste = 0.8;                    // that it counts on, of what its engine gives there
constexpr double kOvertakingSamplingStep_m = 10.0;  // between two places at which the way is checked
constexpr double kUneven_m = 0.25;                  // of the other lane's middle against a line along the own one

}  // namespace

double OvertakingStart::TopSpeed(std::uint32_t id, double from_m, double to_m) const {
  double top = Cap_mps(out_.agents[id], in_.traits[id]);
  for (double at = from_m; at < to_m + kOvertakingSamplingStep_m; at += kOvertakingSamplingStep_m)
    top = std::min(top, in_.limits.AllowedAt(id, std::min(at, to_m)));
  return top;
}

// To the middle of the lane of oncoming traffic, from its front bumper on.
std::optional<Piece> OvertakingStart::PieceOut(std::uint32_t id, double top_mps) const {
  const Agent& agent = out_.agents[id];
  const Piece& last = agent.path.back();
  const std::int64_t opposite = in_.map.opposites[last.track];
  const double begin = agent.o_m + 0.5 * in_.traits[id].length_m, d = begin - last.zero_m;
  const bool settled = (last.offset_m == 0.0 && last.slope == 0.0) || begin > last.blend_from_m + last.blend_m;
  if (opposite < 0 || !settled || last.aside_m != 0.0 || d > in_.map.graph[last.track].length_m()) return std::nullopt;
  const auto there = static_cast<std::uint32_t>(opposite);
  const lanes::CurvePoint at = in_.map.graph[last.track].curve.At(d),
                          to = in_.map.graph[there].curve.At(in_.map.graph.Across(last.track, d, there));
  Piece piece{last.track, last.zero_m, begin};
  piece.blend_from_m = begin;
  piece.aside_m = (to.p_W - at.p_W).head<2>().dot(at.left_W());
  piece.offset_m = -piece.aside_m;
  const double time = LaneChangeTime_s(piece.aside_m);
  piece.blend_m = std::max(kMinLaneChangeLength_m,
                           time * std::min(std::max(agent.speed_mps, top_mps), agent.speed_mps + kFasterOut_mps));
  return piece;
}

PassCase OvertakingStart::CaseOf(std::uint32_t id, const Leader& passed, double top_mps, double aside_m,
                                 double to_m) const {
  const Agent& agent = out_.agents[id];
  const AgentTraits& traits = in_.traits[id];
  const double front = agent.o_m + 0.5 * traits.length_m;
  double steepest = 0.0;
  for (const RouteSegment& stretch : out_.stretches[id]) {
    for (double at = std::max(front, stretch.begin_m); at < std::min(to_m, stretch.end_m);
         at += kOvertakingSamplingStep_m) {
      steepest = std::max(steepest, in_.map.graph[stretch.track].curve.At(at - stretch.zero_m).grade);
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
      0.0, passed.gap_m + passed.length_m + traits.idm.min_gap_m + kBackGap_s * pass.passed_mps + traits.length_m);
  pass.back_s = LaneChangeTime_s(aside_m), pass.back_least_m = kMinLaneChangeLength_m;
  pass.length_m = traits.length_m;
  return pass;
}

// Whether marks, signs and both lanes let it drive on the other side as far as there.
bool OvertakingStart::MayOvertake(std::uint32_t id, double to_m, double aside_m) const {
  const Agent& agent = out_.agents[id];
  const double half = 0.5 * in_.traits[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  if (!in_.lanes_beside.IsPlain(id, rear, to_m + in_.traits[id].length_m) ||
      !in_.lanes_beside.MayCross(id, aside_m > 0.0 ? 1 : -1, front, to_m))
    return false;
  for (const RouteSegment& stretch : out_.stretches[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < rear) continue;
    const std::int64_t opposite = in_.map.opposites[stretch.track];
    const double low = std::max(rear, stretch.begin_m) - stretch.zero_m,
                 high = std::min(to_m, stretch.end_m) - stretch.zero_m;
    if (opposite < 0 || !in_.map.no_overtaking.Allows(stretch.track, std::max(low, front - stretch.zero_m), high))
      return false;
    const auto track = static_cast<std::uint32_t>(opposite);
    const lanes::Curve& curve = in_.map.graph[track].curve;
    const double from = in_.map.graph.Across(stretch.track, high, track),
                 until = in_.map.graph.Across(stretch.track, low, track);
    for (const lanes::ZoneSide& part : in_.map.zones.Of(track)) {
      if (part.in_m < until && part.out_m > from) return false;
    }
    for (double d = low; d < high + kOvertakingSamplingStep_m; d += kOvertakingSamplingStep_m) {
      const double there = in_.map.graph.Across(stretch.track, std::min(d, high), track);
      const lanes::CurvePoint at = in_.map.graph[stretch.track].curve.At(std::min(d, high));
      const double offset = (curve.At(there).p_W - at.p_W).head<2>().dot(at.left_W());
      if (curve.WidthAt(there) < kMinLaneChangeWidth_m || std::fabs(offset - aside_m) > kUneven_m) return false;
    }
  }
  return true;
}

}  // namespace rodeira::traffic

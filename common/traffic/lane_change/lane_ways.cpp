// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/lane_change/lane_ways.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "common/traffic/lane_change/lane_change.hpp"
#include "common/traffic/pedestrians/stopping.hpp"
#include "common/traffic/perception/passing_by.hpp"
#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kApart_m = 6.0;             // between the middles of the two lanes, at most …
constexpr double kAside = 0.1;               // … and between their directions, rad
constexpr double kLaneSamplingStep_m = 4.0;  // between two places at which a lane is checked
constexpr double kRouteSight_m = 500.0;      // within which a driver considers the lane from which the route goes on
constexpr double kEndNotice_s = 1.5, kEndBraking_mps2 = 1.5;  // within which a lane's end is noticed and stopped for
constexpr double kWaitingMargin_m = 3.0;                      // before the last place from which a change is possible
constexpr double kShortTrack_m = 60.0;                        // from one junction to the next
constexpr double kWaitsBeside_s = 20.0;                       // for a gap in the lane beside
constexpr double kEndMargin_m = 0.5;                          // from the end of a change to the end of the lane

const lanes::Link* LinkTo(const lanes::Track& track, std::uint32_t to) {
  const auto link =
      std::find_if(track.next.begin(), track.next.end(), [&](const lanes::Link& on) { return on.to == to; });
  return link == track.next.end() ? nullptr : &*link;
}

// Wide enough and not too bent between two distances.
bool IsEasy(const lanes::Curve& curve, double low_m, double high_m, double tightest_1pm) {
  for (double d = low_m; d < high_m + kLaneSamplingStep_m; d += kLaneSamplingStep_m) {
    const double at = std::min(d, high_m);
    if (curve.WidthAt(at) < kMinLaneChangeWidth_m || std::fabs(curve.At(at).curvature_1pm) > tightest_1pm) return false;
  }
  return true;
}

}  // namespace

// The path to the middle of the lane beside, from its front bumper on; as long as comfort asks at the speed that it may
// come to.
std::optional<Piece> LaneWays::PieceBeside(std::uint32_t id, int side, double ends_m, double tight_m) const {
  const Agent& agent = in_.agents[id];
  const Piece& last = agent.path.back();
  const lanes::Track& track = in_.map.graph[last.track];
  const auto beside = side > 0 ? track.left : track.right;
  const double begin = agent.o_m + 0.5 * in_.traits[id].length_m, d = begin - last.zero_m;
  const bool settled = (last.offset_m == 0.0 && last.slope == 0.0) || begin > last.blend_from_m + last.blend_m;
  if (!beside || !settled || d > track.length_m()) return std::nullopt;
  const lanes::CurvePoint at = track.curve.At(d);
  double there = in_.map.graph.Across(last.track, d, *beside);
  lanes::CurvePoint to = in_.map.graph[*beside].curve.At(there);
  for (int turn = 0; turn < 3;
       ++turn) {  // the foot: on banked climbs what lies across the road does not lie across the lane
    const Eigen::Vector2d away = (at.p_W - to.p_W).head<2>();
    there += away.dot(to.ahead_W) / std::max(0.2, 1.0 - to.curvature_1pm * away.dot(to.left_W()));
    to = in_.map.graph[*beside].curve.At(there);
  }
  Piece piece{*beside, begin - there, begin};
  piece.blend_from_m = begin;
  piece.offset_m = (at.p_W - to.p_W).head<2>().dot(to.left_W());
  piece.slope = at.ahead_W.dot(to.left_W()) / std::max(0.2, at.ahead_W.dot(to.ahead_W));
  const double size = std::fabs(piece.offset_m);
  if (size > kApart_m || std::fabs(piece.slope) > kAside) return std::nullopt;
  const auto length = [&](double time_s) {
    const double fastest = std::min(agent.speed_mps + in_.traits[id].idm.acceleration_mps2 * time_s,
                                    std::max(agent.speed_mps, in_.limits.Limit_mps(id, *beside, there)));
    return std::max(kMinLaneChangeLength_m, time_s * fastest);
  };
  piece.blend_m = length(LaneChangeTime_s(piece.offset_m));
  const double left = ends_m - begin - 0.5 * in_.traits[id].length_m;
  if (piece.blend_m > left) piece.blend_m = std::max(left, length(UrgentLaneChangeTime_s(piece.offset_m)));
  const double tight = tight_m - begin - kEndMargin_m;
  if (piece.blend_m > tight && tight >= kMinTightChangeLength_m &&
      agent.speed_mps < TightChange_mps(piece.offset_m, tight))
    piece.blend_m = tight;
  return piece;
}

bool LaneWays::ChangesSlowly(std::uint32_t id) const {
  const lanes::Track& track = in_.map.graph[in_.agents[id].path.back().track];
  if (track.junction >= 0 || !(track.left || track.right)) return false;
  return track.length_m() < kShortTrack_m ||
         std::fabs(track.curve.At(in_.agents[id].o_m - in_.agents[id].path.back().zero_m).curvature_1pm) >
             kTightestLaneChange_1pm;
}

bool LaneWays::IsPlain(std::uint32_t id, double from_m, double to_m, double tightest_1pm) const {
  const RouteSegment* before = nullptr;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    const bool beside = before != nullptr && before->changes;  // then it is there from its rear on
    const double begin = beside ? from_m : stretch.begin_m;
    if (begin > to_m) break;
    if (before != nullptr && !beside && begin > from_m) {
      const lanes::Link* link = LinkTo(in_.map.graph[before->track], stretch.track);
      if (link == nullptr || std::fabs(link->offset_m) > kSameLaneOffset_m || std::fabs(link->slope) > kSameLaneSlope)
        return false;
    }
    before = &stretch;
    if (stretch.end_m < from_m || stretch.changes) continue;
    const lanes::Track& track = in_.map.graph[stretch.track];
    if (track.junction >= 0) return false;
    const double low = std::max(from_m, begin) - stretch.zero_m, high = std::min(to_m, stretch.end_m) - stretch.zero_m;
    for (const lanes::ZoneSide& part : in_.map.zones.Of(stretch.track)) {
      if (part.in_m < high && part.out_m > low) return false;
    }
    for (const StopLine& line : in_.map.plans[stretch.track].lines) {
      if (line.d_m > low && line.d_m < high) return false;
    }
    if (NearCrossing(in_.people, stretch.track, low, high) || !IsEasy(track.curve, low, high, tightest_1pm))
      return false;
  }
  return in_.stretches[id].back().end_m >= to_m;
}

bool LaneWays::IsFree(std::uint32_t id, double from_m, double to_m) const {
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < from_m || stretch.changes) continue;
    const double low = std::max(from_m, stretch.begin_m) - stretch.zero_m,
                 high = std::min(to_m, stretch.end_m) - stretch.zero_m;
    for (const lanes::ZoneSide& part : in_.map.zones.Of(stretch.track)) {
      if (part.in_m < high && part.out_m > low) return false;
    }
    for (const StopLine& line : in_.map.plans[stretch.track].lines) {
      if (line.d_m > low && line.d_m < high) return false;
    }
    if (NearCrossing(in_.people, stretch.track, low, high)) return false;
  }
  return in_.stretches[id].back().end_m >= to_m || !in_.stretches[id].back().goes_on;
}

bool LaneWays::MayCross(std::uint32_t id, int side, double from_m, double to_m) const {
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (stretch.begin_m > to_m) break;
    if (stretch.end_m < from_m) continue;
    if (!in_.map.marks.MayCross(stretch.track, side > 0 ? lanes::Side::kLeft : lanes::Side::kRight,
                                std::max(from_m, stretch.begin_m) - stretch.zero_m,
                                std::min(to_m, stretch.end_m) - stretch.zero_m))
      return false;
  }
  return true;
}

double LaneWays::RouteEnds(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const Route* route = RouteOf(in_.map, agent);
  if (route == nullptr) return kNoBarrier_m;
  std::uint32_t track = agent.path.back().track;
  Choice choice{agent.links, route->LegOn(agent.leg, track)};
  double end = agent.path.back().zero_m + in_.map.graph[track].length_m();
  while (route->Changes(choice.leg, track) > 0) {
    if (route->MustChange(choice.leg, track)) return end;
    if (end > agent.o_m + kRouteSight_m || in_.map.graph[track].next.empty()) break;
    const lanes::Link& on = NextLink(in_.map, in_.settings.seed, id, in_.agents[id], track, choice);
    track = on.to;
    end += in_.map.graph[track].length_m() - on.from_d_m;
  }
  return kNoBarrier_m;
}

int LaneWays::FewerChanges(std::uint32_t id, std::uint32_t track) const {
  const Agent& agent = in_.agents[id];
  const Route* route = RouteOf(in_.map, agent);
  if (route == nullptr) return 0;
  const std::uint32_t leg = route->LegOn(agent.leg, track), own = agent.path.back().track;
  const bool here = route->Reaches(agent.leg, own), there = route->Reaches(leg, track);
  if (!here || !there) return (there ? 1 : 0) - (here ? 1 : 0);
  return route->Changes(agent.leg, own) - route->Changes(leg, track);
}

std::optional<EndingLane> LaneWays::EndAhead(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const Route* route = RouteOf(in_.map, agent);
  std::uint32_t leg = agent.leg;
  for (const RouteSegment& stretch : in_.stretches[id]) {
    if (route != nullptr) leg = route->LegOn(leg, stretch.track);
    if (stretch.changes || (stretch.goes_on && !in_.map.lane_ends.IsBlunt(stretch.track))) continue;
    const bool must = route != nullptr ? leg < route->legs() && route->MustChange(leg, stretch.track)
                                       : in_.map.lane_ends.IsBlunt(stretch.track);
    const double last = in_.map.lane_ends.ChangeEnds_m(stretch.track);
    if (!must || last < 0.0) continue;
    const AgentTraits& traits = in_.traits[id];
    const double ends = stretch.zero_m + last - kEndMargin_m,
                 waits = ends - kMinLaneChangeLength_m - 0.5 * traits.length_m - kWaitingMargin_m;
    const double room = waits + kWaitingMargin_m - FrontOf(agent, traits);
    if (waits - traits.length_m < stretch.begin_m || room < 0.0) continue;
    // One that comes into sight too late to stop for it, as where it begins to drive, is driven past.
    const double stops = agent.speed_mps * (kEndNotice_s + agent.speed_mps / (2.0 * kEndBraking_mps2));
    if (!agent.seeks && stops > room) continue;
    return EndingLane{waits, ends};
  }
  return std::nullopt;
}

// Where its front waits for a gap on a short track that its route leaves by the lane beside; none where it needs no
// change, is past that place, or has waited long: it then goes on and comes there anew.
std::optional<double> LaneWays::WaitsBeside_m(std::uint32_t id) const {
  const Agent& agent = in_.agents[id];
  const Route* route = RouteOf(in_.map, agent);
  const Piece& last = agent.path.back();
  if (route == nullptr || agent.waited_s > kWaitsBeside_s) return std::nullopt;
  const std::uint32_t leg = route->LegOn(agent.leg, last.track);
  if (leg >= route->legs() || !route->MustChange(leg, last.track) || !ChangesSlowly(id)) return std::nullopt;
  const double waits =
      last.zero_m + in_.map.graph[last.track].length_m() - kMinTightChangeLength_m - 2.0 * kEndMargin_m;
  const double front = FrontOf(agent, in_.traits[id]);
  if (waits < last.begin_m || front > waits + kEndMargin_m) return std::nullopt;
  return waits;
}

double LaneWays::LaneEnds(std::uint32_t id) const {
  const auto& stretches = in_.stretches[id];
  const double parts = RouteEnds(id);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (stretches[i].changes) continue;
    const auto& next = in_.map.graph[stretches[i].track].next;
    if (next.empty()) return std::min(parts, stretches[i].end_m);
    if (i + 1 == stretches.size()) break;
    const lanes::Link* link = LinkTo(in_.map.graph[stretches[i].track], stretches[i + 1].track);
    if (link != nullptr && link->joins) return std::min(parts, stretches[i].end_m);
  }
  return parts;
}

}  // namespace rodeira::traffic

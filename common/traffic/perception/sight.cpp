// SPDX-License-Identifier: Apache-2.0
// Who is where on the tracks, and who is ahead of whom.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "common/traffic/perception/each_driving.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/lanes/swath.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kComfort_mps2 = 1.5;    // braking within which everything of interest lies …
constexpr double kSightMargin_m = 60.0;  // … and so much more
constexpr double kWithout_m = 1e-9;
constexpr double kAnySpeed_mps = 1e3;

}  // namespace

double TrafficModel::SightOf(const Agent& agent) const {
  return std::min(settings_.sight_m,
                  agent.speed_mps * agent.speed_mps / (2.0 * kComfort_mps2) + 3.0 * agent.speed_mps + kSightMargin_m);
}

// Whether those of the last time, without some at their end, are still what FindStretches would find.
bool TrafficModel::KeepStretches(std::uint32_t id, double far_m) {
  const Agent& agent = agents_[id];
  auto& stretches = stretches_[id];
  const WayKey key{agent.trip,
                   agent.links,
                   agent.leg,
                   agent.path.back().track,
                   agent.path.size(),
                   agent.path.front().begin_m,
                   agent.path.back().zero_m};
  if (key != std::exchange(way_keys_[id], key) || stretches.size() < key.pieces) return false;
  if (stretches.back().end_m < far_m && stretches.back().goes_on) return false;
  for (; stretches.size() > key.pieces && stretches[stretches.size() - 2].end_m >= far_m; ++ways_[id])
    stretches.pop_back();
  return true;
}

void TrafficModel::LookBelow(std::uint32_t id) {
  Below& below = below_[id];
  const Piece& piece = PieceAt(agents_[id].path, agents_[id].o_m);
  const std::uint32_t track = piece.track;
  const double d = agents_[id].o_m - piece.zero_m;
  if (below.track == track) {
    if (d < below.plan.from_m || d >= below.plan.to_m) below.plan = map_->plans[track].plan.Around(d);
    return;
  }
  const lanes::Track& on = graph()[track];
  below = {track,
           static_cast<std::int32_t>(on.lane.road),
           on.lane.lane,
           !on.next.empty(),
           on.left || on.right,
           on.length_m(),
           on.curve.straight(),
           std::nullopt,
           0.0,
           map_->plans[track].plan.Around(d)};
  if (!on.curve.straight() || on.curve.straight()->bank_1pm != 0.0) return;
  below.turned = AttitudeOn(*on.curve.straight());
  below.grade = GradeOf(*below.turned);
}

PathFrame TrafficModel::FrameOf(std::uint32_t id, double odometer_m) const {
  const Piece& piece = PieceAt(agents_[id].path, odometer_m);
  const double d = odometer_m - piece.zero_m;
  const Below& below = below_[id];
  return FrameOn(
      piece, below.track == piece.track && below.straight ? below.straight->At(d) : graph()[piece.track].curve.At(d),
      odometer_m);
}

bool TrafficModel::HasBeside(std::uint32_t id, std::uint32_t track) const {
  if (below_[id].track == track) return below_[id].has_beside;
  return graph()[track].left || graph()[track].right;
}

Stretch TrafficModel::StretchOn(std::uint32_t track, double zero_m, double begin_m, double end_m, bool changes) const {
  const lanes::Track& on = graph()[track];
  const TrackPlan& plan = map_->plans[track];
  return {track,
          zero_m,
          begin_m,
          end_m,
          changes,
          !on.next.empty(),
          on.left || on.right,
          !plan.lines.empty(),
          !zones().ConflictsOf(track).empty(),
          plan.one_limit ? plan.limit_mps : -1.0,
          plan.plan.At(begin_m - zero_m).speed_mps};
}

// Whether its stretches go as far as that, or to the end of its way.
bool TrafficModel::SeesTo(std::uint32_t id, double odometer_m) const {
  const Stretch& last = stretches_[id].back();
  return last.end_m >= odometer_m || !last.goes_on;
}

// From the piece under the rear bumper to `range` beyond the front one.
void TrafficModel::FindStretches(std::uint32_t id, double range_m) {
  const Agent& agent = agents_[id];
  auto& stretches = stretches_[id];
  const double far = agent.o_m + 0.5 * traits_[id].length_m + range_m;
  if (KeepStretches(id, far)) return;
  ++ways_[id];
  stretches.clear();
  for (std::size_t i = 0; i < agent.path.size(); ++i) {
    const Piece& piece = agent.path[i];
    const double end =
        i + 1 < agent.path.size() ? agent.path[i + 1].begin_m : piece.zero_m + graph()[piece.track].length_m();
    if (i > 0 && agent.path[i - 1].track == piece.track &&
        agent.path[i - 1].zero_m == piece.zero_m) {  // beside its lane's middle, or back
      stretches.back().end_m = end;
      stretches.back().changes = end < piece.zero_m + graph()[piece.track].length_m() - kWithout_m;
      continue;
    }
    stretches.push_back(StretchOn(piece.track, piece.zero_m, piece.begin_m, end,
                                  end < piece.zero_m + graph()[piece.track].length_m() - kWithout_m));
  }
  const Route* route = RouteOf(agent);
  Choice choice{agent.links, route != nullptr ? route->LegOn(agent.leg, stretches.back().track) : 0};
  while (stretches.back().end_m < far) {
    const Stretch& last = stretches.back();
    if (!last.goes_on) break;
    const lanes::Link& on = NextLink(id, last.track, choice);
    const double zero = last.end_m - on.from_d_m;
    stretches.push_back(StretchOn(on.to, zero, last.end_m, zero + graph()[on.to].length_m(), false));
  }
}

void TrafficModel::SeeOthers(std::span<const driver::Footprint> others) {
  constexpr double kWidest_m = 3.0;
  if (any_block_) {
    for (auto& blocks : blocks_) blocks.clear();
  }
  any_block_ = !others.empty();
  for (const driver::Footprint& other : others) {
    const double reach = 0.5 * std::hypot(other.length_m, other.width_m) + kWidest_m;
    for (const lanes::Graph::Beside& beside : graph().TracksAt({other.x_m, other.y_m}, reach)) {
      const lanes::CurvePoint at = graph()[beside.track].curve.At(beside.foot.d_m);
      const Eigen::Vector2d away = Eigen::Vector2d(other.x_m, other.y_m) - at.p_W.head<2>();
      const double d = beside.foot.d_m + (away.dot(at.ahead_W));  // beyond an end too
      const double turn = other.heading_rad - std::atan2(at.ahead_W.y(), at.ahead_W.x());
      const double c = std::fabs(std::cos(turn)), s = std::fabs(std::sin(turn));
      const double along = 0.5 * (c * other.length_m + s * other.width_m),
                   across = 0.5 * (s * other.length_m + c * other.width_m);
      const double offset = beside.foot.offset_m;
      blocks_[beside.track].push_back(
          {{d - along, d + along, offset - across, offset + across, other.speed_mps * std::cos(turn)}, d, other.id});
    }
  }
}

// On the tracks below it, and on those beside that it takes up.
void TrafficModel::BeSeen(std::uint32_t id) {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half, rear = agent.o_m - half;
  std::int32_t from = -1;
  for (const Stretch& stretch : stretches_[id]) {
    if (stretch.begin_m >= front) break;
    if (stretch.end_m > rear) occupants_.Add(stretch.track, {id, from, rear - stretch.zero_m, front - stretch.zero_m});
    from = static_cast<std::int32_t>(stretch.track);
  }
  if (agent.change.side != 0) AppearOnLaneLeft(id);
  if (!agent.overtaking.active()) return;
  any_overtaking_ = true;
  FaceOncoming(id);
}

void TrafficModel::See(std::span<const driver::Footprint> others) {
  SeeOthers(others);
  for (const std::uint32_t track : occupants_.taken()) {
    for (const lanes::Parting& part : zones().PartingsOf(track)) parts_[part.other] = 0;
  }
  occupants_.Clear();
  if (any_facing_) {
    for (auto& facing : facing_) facing.clear();
  }
  any_facing_ = any_overtaking_ = false;
  is_overtaken_.assign(agents_.size(), 0);
  EachDriving([&](std::uint32_t
                      id) {  // and as far as zones are its own, however slowly it drives now, or it looks who overtakes
    LookBelow(id);
    const Agent& agent = agents_[id];
    const double own = agent.granted_m - agent.o_m - 0.5 * traits_[id].length_m;
    FindStretches(id, std::max({SightOf(agent), own, agent.overtaking.active() ? settings_.overtaking.sight_m : 0.0,
                                people_ ? StoppingWay(id) : 0.0}));
    if (!pool_) BeSeen(id);
  });
  for (std::uint32_t id = 0; pool_ && id < agents_.size(); ++id) {
    if (agents_[id].on_road) BeSeen(id);
  }
  occupants_.Sort();
  for (const std::uint32_t track : occupants_.taken()) Part(track);
}

// Somebody is on this track: who drives on those that part from it must look. Of the others nobody need read what parts
// from them.
void TrafficModel::Part(std::uint32_t track) {
  for (const lanes::Parting& part : zones().PartingsOf(track)) parts_[part.other] = 1;
}

// Those on which somebody may be.
std::span<const lanes::Parting> TrafficModel::PartingsOf(std::uint32_t track) const {
  return parts_[track] != 0 ? zones().PartingsOf(track) : std::span<const lanes::Parting>();
}

void TrafficModel::LookAhead() {
  EachDriving([&](std::uint32_t id) { ahead_[id] = FindAhead(id); });
}

// The nearest of agents on the tracks of the way and what else stands in it. Or, of those on the lane that it is
// leaving, and of agents on tracks that part from the way, as long as they are not clear, the one who lets it drive on
// least (he need not be the nearest: of two who turn off to different sides one may drive away while the other one
// stands, and who drives away on the new lane may be nearer than a queue on the old one), if that is less.
Ahead TrafficModel::FindAhead(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m, front = agent.o_m + half;
  const double half_width = 0.5 * traits_[id].width_m + settings_.side_margin_m;
  const double aside = agent.path.back().aside_m;  // it drives there, and everywhere between
  Ahead ahead, apart;
  double apart_lets = 0.0;
  const auto lets = [&](const Ahead& other) {
    return driver::IdmAcceleration(traits_[id].idm, agent.speed_mps, kAnySpeed_mps, other.gap_m, other.speed_mps);
  };
  const auto is_before = [&](const Occupant& other, double zero_m) {
    return other.id != id && zero_m + other.middle_m() > agent.o_m + kWithout_m;
  };
  const auto is_beside = [&](const Occupant& other, double gap) {
    if (agent.overtaking.active() && IsPassed(agent.overtaking, front, other.id, -1, gap)) return true;
    return any_overtaking_ && agents_[other.id].overtaking.passed == id && !agents_[other.id].overtaking.back;
  };
  const auto seen = [&](const Occupant& other, double gap) -> Ahead {
    const double side = 0.5 * traits_[other.id].width_m;
    return {gap, agents_[other.id].speed_mps, other.id, true, -1, traits_[other.id].length_m, side, -side};
  };
  const auto consider = [&](const Occupant& other, double zero_m) {
    const double gap = zero_m + other.rear_m - front;
    if (!is_before(other, zero_m) || (ahead.any && gap >= ahead.gap_m) || is_beside(other, gap)) return;
    ahead = seen(other, gap);
  };
  const auto consider_apart = [&](const Ahead& next) {
    const double next_lets = lets(next);
    if (!apart.any || next_lets < apart_lets) apart = next, apart_lets = next_lets;
  };
  const auto consider_beside_way = [&](const Occupant& other, double zero_m) {
    const double gap = zero_m + other.rear_m - front;
    if (is_before(other, zero_m) && !is_beside(other, gap)) consider_apart(seen(other, gap));
  };
  const auto seen_block = [&](const Block& block, double zero_m) -> std::optional<Ahead> {
    const bool comes =
        block.span.speed_mps < 0.0;  // who comes on the lane beside is looked for otherwise (oncoming.cpp)
    const double left = half_width + (comes ? 0.0 : std::max(0.0, aside)),
                 right = -half_width + (comes ? 0.0 : std::min(0.0, aside));
    if (zero_m + block.middle_m <= agent.o_m || block.span.right_m > left || block.span.left_m < right)
      return std::nullopt;
    const double gap = zero_m + block.span.rear_m - front;
    if (gap >= settings_.sight_m ||
        (agent.overtaking.active() && IsPassed(agent.overtaking, front, -1, block.body, gap)))
      return std::nullopt;
    return Ahead{gap,
                 block.span.speed_mps,
                 -1,
                 true,
                 block.body,
                 block.span.front_m - block.span.rear_m,
                 block.span.left_m,
                 block.span.right_m};
  };
  std::int64_t before = -1;  // the track by which its own way comes
  for (const Stretch& stretch : stretches_[id]) {
    const std::int64_t from = std::exchange(before, stretch.track);
    if (stretch.end_m < agent.o_m || (stretch.changes && agent.change.side == 0)) continue;
    if (ahead.any && agent.change.side == 0 && stretch.begin_m > front + ahead.gap_m + 10.0) break;
    for (Occupant other : occupants_.Beyond(stretch.track, agent.o_m - stretch.zero_m)) {
      if (ahead.any && stretch.zero_m + other.middle_m() - longest_half_m_ - front >= ahead.gap_m) break;
      // Who comes in from beside has his rear in the zone where the ways merge, which its own line keeps it out of.
      if (from >= 0 && other.from >= 0 && other.from != from)
        other.rear_m = std::max(other.rear_m, stretch.begin_m - stretch.zero_m);
      consider(other, stretch.zero_m);
    }
    for (const lanes::Parting& part : PartingsOf(stretch.track)) {
      if (agent.o_m - half > stretch.zero_m + part.out_m) continue;
      for (const Occupant& other : occupants_.On(part.other)) {
        if (other.rear_m < part.other_out_m && other.front_m > part.other_in_m)
          consider_beside_way(other, stretch.zero_m);
      }
    }
    for (const Block& block : BlocksOn(stretch.track)) {
      if (const auto next = seen_block(block, stretch.zero_m); next && (!ahead.any || next->gap_m < ahead.gap_m))
        ahead = *next;
    }
    if (agent.change.side == 0) continue;
    if (const auto old = LaneLeft(id, stretch, front)) {
      const double at = std::max(agent.o_m, stretch.begin_m),
                   zero = at - graph().Across(stretch.track, at - stretch.zero_m, *old);
      for (const Occupant& other : occupants_.Beyond(*old, agent.o_m - zero)) consider_beside_way(other, zero);
      for (const Block& block : BlocksOn(*old)) {
        if (const auto next = seen_block(block, zero)) consider_apart(*next);
      }
    }
  }
  return apart.any && (!ahead.any || apart_lets < lets(ahead)) ? apart : ahead;
}

}  // namespace rodeira::traffic

// Where agents begin, leave and enter again.
#include <algorithm>
#include <cmath>

#include "common/base/random.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawJitter = 101;
constexpr std::uint64_t kDrawLane = 102;
constexpr double kStartJitter = 0.6;     // share of the spacing
constexpr double kStartClear_m = 15.0;   // from others, at the beginning
constexpr double kGentle_mps2 = 0.8;     // an entering car needs no harder braking than this
constexpr double kEnteringShare = 0.95;  // of the speed it wants
constexpr double kEnteringBrake = 1.8;    // times braking times the way to the line: v²
constexpr double kFast_mps = 40.0;
constexpr int kSweeps = 4;
constexpr double kZoneClear_m = 1.0;
constexpr double kNarrow_m = 2.0;

}  // namespace

// Spread evenly over the lanes outside of junctions, jittered, clear of conflict zones and of each other, no faster than lets
// them stop before whatever is ahead.
void TrafficModel::PlaceAll(std::span<const driver::Footprint> others) {
  std::vector<std::uint32_t> tracks;
  double total = 0.0;
  for (std::uint32_t track = 0; track < graph().tracks().size(); ++track) {
    if (graph()[track].junction >= 0) continue;
    tracks.push_back(track);
    total += graph()[track].length_m();
  }
  std::vector<driver::Footprint> taken;
  for (const driver::Footprint& other : others) {
    taken.push_back(other);
    taken.back().length_m += 2.0 * kStartClear_m;
  }
  std::size_t place = 0;
  double before = 0.0;  // length of the tracks before this one
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    Agent& agent = agents_[id];
    const AgentTraits& traits = traits_[id];
    const double spacing = total / static_cast<double>(agents_.size());
    const double jitter = base::RandomUniform({settings_.seed, id, kDrawJitter}, -0.5, 0.5) * kStartJitter;
    const double at = (static_cast<double>(id) + 0.5 + jitter) * spacing;
    while (place + 1 < tracks.size() && before + graph()[tracks[place]].length_m() < at) before += graph()[tracks[place++]].length_m();
    agent.entry = map_->entries[static_cast<std::size_t>(base::RandomUniform({settings_.seed, id, kDrawLane, 0}) *
                                                         static_cast<double>(map_->entries.size()))];
    const double half = 0.5 * traits.length_m, d = at - before;
    bool room = !tracks.empty();
    const lanes::Track* track = room ? &graph()[tracks[place]] : nullptr;
    room = room && d - half > 0.0 && d + half < track->length_m() && track->curve.WidthAt(d) > kNarrow_m;
    if (room) {
      for (const lanes::ZoneSide& part : zones().Of(tracks[place])) {
        const lanes::Zone& zone = zones()[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.in_m[mine] < d + half + kZoneClear_m && zone.out_m[mine] > d - half - kZoneClear_m) room = false;
      }
      for (const double stop : map_->plans[tracks[place]].stops_m) {
        if (std::fabs(stop - d) < half + kZoneClear_m) room = false;
      }
      const lanes::CurvePoint p = track->curve.At(d);
      driver::Footprint own{id, p.p_W.x(), p.p_W.y(), std::atan2(p.ahead_W.y(), p.ahead_W.x()), 0.0, traits.length_m, traits.width_m + 0.2};
      for (const driver::Footprint& other : taken) room = room && !driver::Overlap(own, other);
      own.length_m += 2.0 * settings_.idm.standing_gap_m;
      if (room) taken.push_back(own);
    }
    if (!room) {
      waiting_.push_back(id);
      continue;
    }
    agent.on_road = true;
    agent.o_m = d;
    agent.path = {{tracks[place], 0.0, 0.0, 0.0, 0.0, 1.0}};
  }
  for (Agent& agent : agents_) agent.speed_mps = agent.on_road ? kFast_mps : 0.0;  // that they look far
  See(others);
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    Agent& agent = agents_[id];
    if (!agent.on_road) continue;
    const driver::IdmSettings& idm = traits_[id].idm;
    double speed = Allowed(id).speed_mps * traits_[id].speed_factor;
    if (ahead_[id].any) {
      const double gap = std::max(0.0, ahead_[id].gap_m - idm.standing_gap_m);
      speed = std::min({speed, gap / (ahead_[id].id < 0 ? 2.0 * idm.time_gap_s : idm.time_gap_s), std::sqrt(2.0 * idm.braking_mps2 * gap)});
    }
    FindPassage(id);
    if (passages_[id].any) speed = std::min(speed, std::sqrt(kEnteringBrake * idm.braking_mps2 * std::max(0.0, passages_[id].line_m - agent.o_m - 0.5 * traits_[id].length_m)));
    passages_[id].any = false;
    agent.speed_mps = speed;
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {  // nobody begins with hard braking
    for (std::uint32_t id = 0; id < agents_.size(); ++id) {
      if (!agents_[id].on_road || !ahead_[id].any) continue;
      const double leader = ahead_[id].id < 0 ? ahead_[id].speed_mps : agents_[static_cast<std::size_t>(ahead_[id].id)].speed_mps;
      double& v = agents_[id].speed_mps;
      while (v > 0.1 && driver::IdmAcceleration(traits_[id].idm, v, 100.0, ahead_[id].gap_m, leader) < -kGentle_mps2) v *= 0.95;
    }
  }
}

void TrafficModel::Leave(std::uint32_t id) {
  Agent& agent = agents_[id];
  const std::uint32_t trip = agent.trip + 1;
  const double driven = agent.driven_m;
  agent = Agent();
  agent.trip = trip;
  agent.driven_m = driven;
  const double draw = base::RandomUniform({settings_.seed, id, kDrawLane, trip});
  agent.entry = map_->entries[static_cast<std::size_t>(draw * static_cast<double>(map_->entries.size()))];
  waiting_.push_back(id);
}

// At each entry the first who waits there.
void TrafficModel::Enter() {
  if (waiting_.empty()) return;
  std::vector<bool> tried(graph().tracks().size(), false);
  std::vector<std::uint32_t> left;
  for (const std::uint32_t id : waiting_) {
    const std::uint32_t entry = agents_[id].entry;
    if (tried[entry] || !TryEnter(id)) left.push_back(id);
    tried[entry] = true;
  }
  waiting_ = std::move(left);
}

// With its rear bumper at the lane's beginning, at its own speed or at that of the car ahead, once the gap bears it.
bool TrafficModel::TryEnter(std::uint32_t id) {
  Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const double half = 0.5 * traits.length_m;
  const lanes::Track& track = graph()[agent.entry];
  for (const Block& block : blocks_[agent.entry]) {
    if (block.span.rear_m < traits.length_m + traits.idm.standing_gap_m && block.span.front_m > 0.0) return false;
  }
  if (!track.before.empty()) {  // in the middle of the network: nobody may be on the way there
    for (std::uint32_t other = 0; other < agents_.size(); ++other) {
      if (!agents_[other].on_road) continue;
      const double front = agents_[other].o_m + 0.5 * traits_[other].length_m;
      for (const Stretch& stretch : stretches_[other]) {
        if (stretch.track == agent.entry && stretch.begin_m > front - 1.0 && stretch.begin_m - front < SightOf(agents_[other])) return false;
      }
    }
  }
  Agent entering = agent;
  entering.on_road = true;
  entering.o_m = half;
  entering.path = {{agent.entry, 0.0, 0.0, 0.0, 0.0, 1.0}};
  std::swap(agent, entering);
  const auto wait = [&] {
    std::swap(agent, entering);
    return false;
  };
  FindStretches(id, settings_.sight_m);
  const double limit = map_->plans[agent.entry].limit_mps * traits.speed_factor;
  double speed = kEnteringShare * Allowed(id).speed_mps * traits.speed_factor;
  // Conflict zones right at the beginning must be free, and are its own from now on.
  for (const lanes::ZoneSide& part : zones().Of(agent.entry)) {
    const lanes::Zone& zone = zones()[part.zone];
    const auto mine = static_cast<std::size_t>(part.side), theirs = 1 - mine;
    if (zone.kind == lanes::ZoneKind::kDiverge) continue;
    if (zone.in_m[mine] > traits.length_m + 2.0 && zone.in_m[mine] > agent.granted_m + traits.length_m + 2.0) break;
    if (!holders_[part.zone][theirs].empty()) return wait();
    agent.granted_m = std::max(agent.granted_m, zone.out_m[mine]);
  }
  FindPassage(id);
  if (passages_[id].any) speed = std::min(speed, std::sqrt(kEnteringBrake * traits.idm.braking_mps2 * std::max(0.0, passages_[id].line_m - traits.length_m)));
  passages_[id].any = false;
  // Nobody may stand where it enters, not even with its rear; agents have moved since they were last seen.
  for (std::uint32_t other = 0; other < agents_.size(); ++other) {
    if (other == id || !agents_[other].on_road) continue;
    for (const Piece& piece : agents_[other].path) {
      if (piece.track == agent.entry && agents_[other].o_m - 0.5 * traits_[other].length_m - piece.zero_m < traits.length_m + 2.0 * traits.idm.standing_gap_m) return wait();
    }
  }
  const Ahead ahead = FindAhead(id);
  if (ahead.any) {
    const auto safe = [&](double v) {
      return ahead.gap_m > 2.0 * traits.idm.standing_gap_m && ahead.gap_m >= traits.idm.standing_gap_m + v * traits.idm.time_gap_s &&
             driver::IdmAcceleration(traits.idm, v, limit, ahead.gap_m, ahead.speed_mps) > -kGentle_mps2;
    };
    if (!safe(speed)) speed = std::clamp(ahead.speed_mps, 0.0, speed);
    if (!safe(speed)) return wait();
  }
  agent.speed_mps = speed;
  if (agent.granted_m > 0.0) {
    agent.grants = {{agent.granted_m, next_grant_++, false}};
    HoldZones(id);
  }
  return true;
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
// Where agents begin.
#include <algorithm>
#include <cmath>

#include "common/core/base/random.hpp"
#include "common/traffic/demand/spawn.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawJitter = 101;
constexpr double kStartJitter = 0.6;    // share of the spacing
constexpr double kStartClear_m = 15.0;  // from others, at the beginning
constexpr double kFast_mps = 40.0;
constexpr int kSweeps = 4;

}  // namespace

// Spread evenly over the lanes outside of junctions that somebody could have come to, jittered, clear of conflict zones
// and of each other, no faster than lets them stop before whatever is ahead.
void TrafficModel::PlaceAll(std::span<const driver::Footprint> others) {
  std::vector<std::uint32_t> tracks;
  double total = 0.0;
  for (std::uint32_t track = 0; track < graph().tracks().size(); ++track) {
    if (graph()[track].junction >= 0 || !map_->reached[track]) continue;
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
  for (std::uint32_t id = 0; id < settings_.vehicles; ++id) {
    Agent& agent = agents_[id];
    const AgentTraits& traits = traits_[id];
    const double spacing = total / static_cast<double>(settings_.vehicles);
    const double jitter = base::RandomUniform({settings_.seed, id, kDrawJitter}, -0.5, 0.5) * kStartJitter;
    const double at = (static_cast<double>(id) + 0.5 + jitter) * spacing;
    while (place + 1 < tracks.size() && before + graph()[tracks[place]].length_m() < at)
      before += graph()[tracks[place++]].length_m();
    agent.entry = DrawEntry(id, 0);
    const double half = 0.5 * traits.length_m, d = at - before;
    bool room = !tracks.empty();
    const lanes::Track* track = room ? &graph()[tracks[place]] : nullptr;
    room = room && d - half > 0.0 && d + half < track->length_m() && track->curve.WidthAt(d) > kMinSpawnWidth_m;
    if (room) {
      for (const lanes::ZoneSide& part : zones().Of(tracks[place])) {
        const lanes::Zone& zone = zones()[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.in_m[mine] < d + half + kZoneClearance_m && zone.out_m[mine] > d - half - kZoneClearance_m)
          room = false;
      }
      for (const StopLine& line : map_->plans[tracks[place]].lines) {
        if (std::fabs(line.d_m - d) < half + kZoneClearance_m) room = false;
      }
      const lanes::CurvePoint p = track->curve.At(d);
      driver::Footprint own{id,  p.p_W.x(),       p.p_W.y(),           std::atan2(p.ahead_W.y(), p.ahead_W.x()),
                            0.0, traits.length_m, traits.width_m + 0.2};
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
  LookAhead();
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    Agent& agent = agents_[id];
    if (!agent.on_road) continue;
    const driver::IdmSettings& idm = traits_[id].idm;
    double speed = std::min(Allowed(id, agents_[id].o_m).speed_mps * traits_[id].speed_factor, traits_[id].top_mps);
    if (ahead_[id].any) {
      const double gap = std::max(0.0, ahead_[id].gap_m - idm.standing_gap_m);
      speed = std::min({speed, gap / (ahead_[id].id < 0 ? 2.0 * idm.time_gap_s : idm.time_gap_s),
                        std::sqrt(2.0 * idm.braking_mps2 * gap)});
    }
    agent.speed_mps = std::min(speed, AtMostForLine(id));
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {  // nobody begins with hard braking
    for (std::uint32_t id = 0; id < agents_.size(); ++id) {
      if (!agents_[id].on_road || !ahead_[id].any) continue;
      const double leader =
          ahead_[id].id < 0 ? ahead_[id].speed_mps : agents_[static_cast<std::size_t>(ahead_[id].id)].speed_mps;
      double& v = agents_[id].speed_mps;
      while (v > 0.1 &&
             driver::IdmAcceleration(traits_[id].idm, v, 100.0, ahead_[id].gap_m, leader) < -kSpawnBraking_mps2)
        v *= 0.95;
    }
  }
}

}  // namespace rodeira::traffic

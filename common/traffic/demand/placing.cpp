// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/placing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/driving/driver/idm.hpp"
#include "common/traffic/demand/spawn.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawJitter = 101;
constexpr double kStartJitter = 0.6;    // share of the spacing
constexpr double kStartClear_m = 15.0;  // from others, at the beginning
constexpr double kFast_mps = 40.0;
constexpr int kSweeps = 4;

}  // namespace

// Spread evenly over the lanes outside of junctions that a vehicle could have come to, jittered, clear of conflict
// zones and of each other, no faster than lets them stop before whatever is ahead.
void Placing::PlaceAll(std::span<const driver::Footprint> others) {
  std::vector<std::uint32_t> tracks;
  double total = 0.0;
  for (std::uint32_t track = 0; track < in_.map.graph.tracks().size(); ++track) {
    if (in_.map.graph[track].junction >= 0 || !in_.map.reached[track]) continue;
    tracks.push_back(track);
    total += in_.map.graph[track].length_m();
  }
  std::vector<driver::Footprint> taken;
  for (const driver::Footprint& other : others) {
    taken.push_back(other);
    taken.back().length_m += 2.0 * kStartClear_m;
  }
  std::size_t place = 0;
  double before = 0.0;  // length of the tracks before this one
  for (std::uint32_t id = 0; id < in_.settings.vehicles; ++id) {
    Agent& agent = out_.agents[id];
    const AgentTraits& traits = in_.traits[id];
    const double spacing = total / static_cast<double>(in_.settings.vehicles);
    const double jitter = base::RandomUniform({in_.settings.seed, id, kDrawJitter}, -0.5, 0.5) * kStartJitter;
    const double at = (static_cast<double>(id) + 0.5 + jitter) * spacing;
    while (place + 1 < tracks.size() && before + in_.map.graph[tracks[place]].length_m() < at)
      before += in_.map.graph[tracks[place++]].length_m();
    agent.entry = out_.entering.DrawEntry(id, 0);
    const double half = 0.5 * traits.length_m, d = at - before;
    bool room = !tracks.empty();
    const lanes::Track* track = room ? &in_.map.graph[tracks[place]] : nullptr;
    room = room && d - half > 0.0 && d + half < track->length_m() && track->curve.WidthAt(d) > kMinSpawnWidth_m;
    if (room) {
      for (const lanes::ZoneSide& part : in_.map.zones.Of(tracks[place])) {
        const lanes::Zone& zone = in_.map.zones[part.zone];
        const auto mine = static_cast<std::size_t>(part.side);
        if (zone.in_m[mine] < d + half + kZoneClearance_m && zone.out_m[mine] > d - half - kZoneClearance_m)
          room = false;
      }
      for (const StopLine& line : in_.map.plans[tracks[place]].lines) {
        if (std::fabs(line.d_m - d) < half + kZoneClearance_m) room = false;
      }
      const lanes::CurvePoint p = track->curve.At(d);
      driver::Footprint own{id,  p.p_W.x(),       p.p_W.y(),           std::atan2(p.ahead_W.y(), p.ahead_W.x()),
                            0.0, traits.length_m, traits.width_m + 0.2};
      for (const driver::Footprint& other : taken) room = room && !driver::Overlap(own, other);
      own.length_m += 2.0 * in_.settings.idm.min_gap_m;
      if (room) taken.push_back(own);
    }
    if (!room) {
      out_.waiting.push_back(id);
      continue;
    }
    agent.on_road = true;
    agent.o_m = d;
    agent.path = {{tracks[place], 0.0, 0.0, 0.0, 0.0, 1.0}};
  }
  for (Agent& agent : out_.agents) agent.speed_mps = agent.on_road ? kFast_mps : 0.0;  // that they look far
  out_.observation.See(others);
  out_.observation.FindLeaders();
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    Agent& agent = out_.agents[id];
    if (!agent.on_road) continue;
    const driver::IdmSettings& idm = in_.traits[id].idm;
    double speed = std::min(in_.limits.Allowed(id, out_.agents[id].o_m).speed_mps * in_.traits[id].speed_factor,
                            in_.traits[id].top_mps);
    if (in_.ahead[id].any) {
      const double gap = std::max(0.0, in_.ahead[id].gap_m - idm.min_gap_m);
      speed = std::min({speed, gap / (in_.ahead[id].id < 0 ? 2.0 * idm.time_gap_s : idm.time_gap_s),
                        std::sqrt(2.0 * idm.braking_mps2 * gap)});
    }
    agent.speed_mps = std::min(speed, out_.entering.AtMostForLine(id));
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {  // no vehicle begins with hard braking
    for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
      if (!out_.agents[id].on_road || !in_.ahead[id].any) continue;
      const double leader = in_.ahead[id].id < 0 ? in_.ahead[id].speed_mps
                                                 : out_.agents[static_cast<std::size_t>(in_.ahead[id].id)].speed_mps;
      double& v = out_.agents[id].speed_mps;
      while (v > 0.1 &&
             driver::IdmAcceleration(in_.traits[id].idm, v, 100.0, in_.ahead[id].gap_m, leader) < -kSpawnBraking_mps2)
        v *= 0.95;
    }
  }
}

}  // namespace rodeira::traffic

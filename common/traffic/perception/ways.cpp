// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/perception/ways.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/traffic/perception/seen_on.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kComfort_mps2 = 1.5;    // braking within which everything of interest lies …
constexpr double kSightMargin_m = 60.0;  // … and so much more

}  // namespace

double Ways::SightOf(const Agent& agent) const {
  return std::min(in_.settings.sight_m,
                  agent.speed_mps * agent.speed_mps / (2.0 * kComfort_mps2) + 3.0 * agent.speed_mps + kSightMargin_m);
}

// Whether those of the last time, without some at their end, are still what FindRouteSegments would find.
bool Ways::KeepRouteSegments(std::uint32_t id, double far_m) {
  const Agent& agent = in_.agents[id];
  auto& stretches = out_.stretches[id];
  const WayKey key{agent.trip,
                   agent.links,
                   agent.leg,
                   agent.path.back().track,
                   agent.path.size(),
                   agent.path.front().begin_m,
                   agent.path.back().zero_m};
  if (key != std::exchange(out_.way_keys[id], key) || stretches.size() < key.pieces) return false;
  if (stretches.back().end_m < far_m && stretches.back().goes_on) return false;
  for (; stretches.size() > key.pieces && stretches[stretches.size() - 2].end_m >= far_m; ++out_.way_numbers[id])
    stretches.pop_back();
  return true;
}

RouteSegment Ways::SegmentOn(std::uint32_t track, double zero_m, double begin_m, double end_m, bool changes) const {
  const lanes::Track& on = in_.map.graph[track];
  const TrackPlan& plan = in_.map.plans[track];
  return {track,
          zero_m,
          begin_m,
          end_m,
          changes,
          !on.next.empty(),
          on.left || on.right,
          !plan.lines.empty(),
          !in_.map.zones.ConflictsOf(track).empty(),
          plan.one_limit ? plan.limit_mps : -1.0,
          plan.plan.At(begin_m - zero_m).speed_mps};
}

bool Ways::SeesTo(std::uint32_t id, double odometer_m) const {
  const RouteSegment& last = out_.stretches[id].back();
  return last.end_m >= odometer_m || !last.goes_on;
}

void Ways::FindRouteSegments(std::uint32_t id, double range_m) {
  const Agent& agent = in_.agents[id];
  auto& stretches = out_.stretches[id];
  const double far = agent.o_m + 0.5 * in_.traits[id].length_m + range_m;
  if (KeepRouteSegments(id, far)) return;
  ++out_.way_numbers[id];
  stretches.clear();
  for (std::size_t i = 0; i < agent.path.size(); ++i) {
    const Piece& piece = agent.path[i];
    const double end =
        i + 1 < agent.path.size() ? agent.path[i + 1].begin_m : piece.zero_m + in_.map.graph[piece.track].length_m();
    if (i > 0 && agent.path[i - 1].track == piece.track &&
        agent.path[i - 1].zero_m == piece.zero_m) {  // beside its lane's middle, or back
      stretches.back().end_m = end;
      stretches.back().changes = end < piece.zero_m + in_.map.graph[piece.track].length_m() - kWithout_m;
      continue;
    }
    stretches.push_back(SegmentOn(piece.track, piece.zero_m, piece.begin_m, end,
                                  end < piece.zero_m + in_.map.graph[piece.track].length_m() - kWithout_m));
  }
  const Route* route = RouteOf(in_.map, agent);
  Choice choice{agent.links, route != nullptr ? route->LegOn(agent.leg, stretches.back().track) : 0};
  while (stretches.back().end_m < far) {
    const RouteSegment& last = stretches.back();
    if (!last.goes_on) break;
    const lanes::Link& on = NextLink(in_.map, in_.settings.seed, id, in_.agents[id], last.track, choice);
    const double zero = last.end_m - on.from_d_m;
    stretches.push_back(SegmentOn(on.to, zero, last.end_m, zero + in_.map.graph[on.to].length_m(), false));
  }
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/demand/appearing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/traffic/demand/demand.hpp"
#include "common/traffic/demand/spawn.hpp"
#include "common/traffic/pedestrians/stopping.hpp"
#include "common/traffic/state/agent.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMaxSpawnBraking_mps2 = 4.0;  // neither the spawned vehicle nor its follower brakes harder
constexpr double kBehindZones_m = 20.0;        // so far behind them vehicles with a reservation may want to stand
constexpr double kNear_m = 30.0;               // farther away no rectangle can touch it

}  // namespace

bool Spawning::IsSpawning(std::uint32_t id) const {
  return std::any_of(out_.appearing.begin(), out_.appearing.end(),
                     [id](const SpawningVehicle& next) { return next.id == id; });
}

// Whether it could ever stand there.
base::Status Spawning::CheckPlace(std::uint32_t id, std::uint32_t track, double d_m) const {
  const double half = 0.5 * in_.traits[id].length_m, low = d_m - half - kZoneClearance_m,
               high = d_m + half + kZoneClearance_m;
  const lanes::Track& lane = in_.map.graph[track];
  const auto refused = [&](const char* what) {
    return base::WrongInput(
        "traffic.no_room",
        fmt::format("a vehicle {:.1f} m long with its middle at {:.2f} m of lane '{}:{}' would stand {}; a place on "
                    "plain lane was expected",
                    in_.traits[id].length_m, lane.curve.StationAt(d_m),
                    in_.map.graph.network().roads()[lane.lane.road].id(), lane.lane.lane, what));
  };
  if (d_m - half < 0.0 || d_m + half > lane.length_m()) return refused("across the lane's end");
  if (lane.junction >= 0) return refused("within a junction");
  if (lane.curve.WidthAt(d_m) < kMinSpawnWidth_m) return refused("where the lane is less than 2 m wide");
  for (const lanes::ZoneSide& part : in_.map.zones.Of(track)) {
    if (part.in_m < high && part.out_m > low) return refused("where other ways cross, merge or part");
  }
  for (const StopLine& line : in_.map.plans[track].lines) {
    if (line.d_m > low && line.d_m < high) return refused("on a line");
  }
  if (NearCrossing(in_.people, track, low, high)) return refused("on a crossing for people on foot");
  return {};
}

// Where it would: the track and d on it.
base::Result<std::pair<std::uint32_t, double>> Spawning::PlaceToSpawn(std::uint32_t id, const std::string& lane,
                                                                      double s_m) const {
  if (id < in_.settings.vehicles || id >= out_.agents.size()) {
    if (in_.settings.scripted.empty())
      return base::WrongInput(
          "traffic.not_scripted",
          fmt::format(
              "agent {} cannot appear: the traffic's settings have no 'scripted' vehicles, as in 'scripted: [car]'",
              id));
    return base::WrongInput(
        "traffic.not_scripted",
        fmt::format("agent {} cannot appear; one of the traffic's 'scripted' was expected, {} to {}", id,
                    in_.settings.vehicles, out_.agents.size() - 1));
  }
  const auto tracks = TracksOf(in_.map.graph, lane, "");
  if (!tracks) return tracks.error().WithContext("");
  double from = 1e18, to = -1e18;
  std::optional<std::uint32_t> there;
  for (const std::uint32_t track : tracks.value()) {
    const lanes::Curve& curve = in_.map.graph[track].curve;
    const double low = std::min(curve.StationAt(0.0), curve.StationAt(curve.length_m())),
                 high = std::max(curve.StationAt(0.0), curve.StationAt(curve.length_m()));
    from = std::min(from, low), to = std::max(to, high);
    if (!there && s_m >= low && s_m <= high) there = track;
  }
  if (!there)
    return base::WrongInput("traffic.off_the_lane",
                            fmt::format("the station {} m is not on the lane '{}', which lies from {:.2f} to {:.2f} m",
                                        s_m, lane, from, to));
  const double d = in_.map.graph[*there].curve.AtStation(s_m);
  if (const auto status = CheckPlace(id, *there, d); !status) return status.error();
  return std::pair(*there, d);
}

base::Status Spawning::CheckSpawn(std::uint32_t id, const std::string& lane, double s_m) const {
  const auto place = PlaceToSpawn(id, lane, s_m);
  return place ? base::Status() : place.error();
}

base::Result<bool> Spawning::Spawn(std::uint32_t id, const std::string& lane, double s_m, double speed_mps) {
  RODEIRA_ASSERT(speed_mps >= 0.0);
  const auto place = PlaceToSpawn(id, lane, s_m);
  if (!place) return place.error();
  if (out_.agents[id].on_road || out_.agents[id].is_crashed || IsSpawning(id)) return false;
  out_.appearing.push_back({id, place.value().first, place.value().second, speed_mps});
  return true;
}

// No rectangle is nearer than it would stand behind that vehicle.
bool Spawning::IsClearFor(const SpawningVehicle& next) const {
  const AgentTraits& traits = in_.traits[next.id];
  const lanes::CurvePoint at = in_.map.graph[next.track].curve.At(next.d_m);
  const driver::Footprint own{next.id,       at.p_W.x(),
                              at.p_W.y(),    std::atan2(at.ahead_W.y(), at.ahead_W.x()),
                              0.0,           traits.length_m + 2.0 * traits.idm.min_gap_m,
                              traits.width_m};
  for (std::uint32_t other = 0; other < out_.agents.size(); ++other) {
    if (other == next.id || !out_.agents[other].on_road) continue;
    const AgentPose pose = in_.body_poses.PoseOf(other);
    const driver::Footprint body = FootprintOf(pose, in_.traits[other]);
    if (std::fabs(pose.p_WB_W.z() - at.p_W.z()) > network::Network::kLevel_m ||
        std::hypot(body.x_m - own.x_m, body.y_m - own.y_m) > kNear_m)
      continue;
    if (driver::Overlap(own, body)) return false;
  }
  return std::none_of(in_.bodies.begin(), in_.bodies.end(),
                      [&](const driver::Footprint& body) { return driver::Overlap(own, body); });
}

// Whether a vehicle counts on that place: it has reserved zones before it, or comes back to it from overtaking, or
// overtakes along it.
bool Spawning::IsTakenUp(std::uint32_t id) const {
  const std::uint32_t track = out_.agents[id].path.front().track;
  if (!in_.facing[track].empty()) return true;
  const double half = 0.5 * in_.traits[id].length_m, low = out_.agents[id].o_m - half,
               high = out_.agents[id].o_m + half;
  for (std::uint32_t other = 0; other < out_.agents.size(); ++other) {
    const Agent& agent = out_.agents[other];
    if (other == id || !agent.on_road) continue;
    double to = -kNoBarrier_m;
    if (!agent.grants.empty()) to = agent.granted_m + kBehindZones_m;
    if (agent.overtaking.active()) to = std::max(to, agent.overtaking.to_m + kBehindZones_m);
    const double rear = agent.o_m - 0.5 * in_.traits[other].length_m;
    for (const RouteSegment& stretch : in_.stretches[other]) {
      if (stretch.track == track && stretch.zero_m + low < to && stretch.zero_m + high > rear) return true;
    }
  }
  return false;
}

// At the speed that it was told, or what the way ahead bears, once no vehicle has to brake hard for it, nor it for
// another.
bool Spawning::TrySpawn(const SpawningVehicle& next) {
  Agent& agent = out_.agents[next.id];
  const AgentTraits& traits = in_.traits[next.id];
  const Agent before = agent;
  const auto wait = [&] {
    agent = before;
    return false;
  };
  const double half = 0.5 * traits.length_m;
  agent.on_road = true;
  agent.o_m = next.d_m;
  agent.entry = next.track;
  agent.speed_mps = next.speed_mps;
  agent.path = {{next.track, 0.0, 0.0, 0.0, 0.0, 1.0}};
  if (const Route* route = RouteOf(in_.map, agent)) agent.leg = route->LegOn(0, next.track);
  if (!IsClearFor(next) || IsTakenUp(next.id)) return wait();
  out_.ways.FindRouteSegments(next.id, in_.settings.sight_m);
  double speed = std::min({next.speed_mps, in_.limits.Allowed(next.id, out_.agents[next.id].o_m).speed_mps,
                           Cap_mps(out_.agents[next.id], in_.traits[next.id]), out_.entering.AtMostForLine(next.id)});
  if (in_.people) speed = std::min(speed, in_.crosswalks.AtMostForPeople(next.id));
  if (speed < 0.0) return wait();
  agent.speed_mps = speed;
  const double limit = std::max(speed, in_.limits.Limit_mps(next.id, next.track, next.d_m));
  const Leader ahead = in_.neighbours.FindLeader(next.id);
  if (ahead.any && in_.following.Following(next.id, limit, true, ahead.gap_m, ahead.speed_mps) < -kMaxSpawnBraking_mps2)
    return wait();
  const Follower follower = in_.neighbours.FindFollower(next.id, next.track, next.d_m, next.d_m - half);
  if (follower.any && in_.following.FollowerDoes(follower, true, follower.gap_m, speed) < -kMaxSpawnBraking_mps2)
    return wait();
  if (in_.full && !out_.full_motion.PlaceFull(next.id)) return wait();
  out_.ahead[next.id] = ahead;
  out_.observation.Part(next.track);
  out_.occupants.Insert(next.track, {next.id, -1, next.d_m - half, next.d_m + half});
  return true;
}

void Spawning::SpawnAll() {
  std::erase_if(out_.appearing, [this](const SpawningVehicle& next) { return TrySpawn(next); });
}

}  // namespace rodeira::traffic

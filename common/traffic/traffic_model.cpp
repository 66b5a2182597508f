#include "common/traffic/traffic_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/base/random.hpp"
#include "common/traffic/road_network.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;
constexpr double kGentle_m = 3e-4;      // what a bend makes of the way of a step, and no more
constexpr double kEntryClear_m = 12.0;  // from a lane's beginning to its first conflict zone

}  // namespace

TrafficModel::Map::Map(std::shared_ptr<const network::Network> of, const driver::SpeedPlanSettings& speed)
    : network(std::move(of)), graph(*network), zones(graph), marks(graph) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) plans.emplace_back(graph, track, speed);
  for (const bool clear : {true, false}) {
    for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
      const bool early = std::any_of(zones.Of(track).begin(), zones.Of(track).end(), [&](const lanes::ZoneSide& side) {
        return zones[side.zone].in_m[static_cast<std::size_t>(side.side)] < kEntryClear_m;
      });
      if (graph[track].entry && !(clear && early)) entries.push_back(track);
    }
    if (!entries.empty()) break;
  }
}

TrafficModel::TrafficModel(const TrafficSettings& settings, std::shared_ptr<const Map> map)
    : settings_(settings), map_(std::move(map)), agents_(settings.vehicles) {
  for (std::uint32_t id = 0; id < settings_.vehicles; ++id) traits_.push_back(TraitsOf(settings_, id));
  for (const AgentTraits& traits : traits_) longest_half_m_ = std::max(longest_half_m_, 0.5 * traits.length_m);
  stretches_.resize(agents_.size());
  ahead_.resize(agents_.size());
  passages_.resize(agents_.size());
  reaches_.resize(agents_.size());
  barriers_.resize(agents_.size());
  occupants_.resize(graph().tracks().size());
  present_.resize(graph().tracks().size());
  blocks_.resize(graph().tracks().size());
  holders_.resize(zones().zones().size());
  comers_.resize(zones().zones().size());
  awaited_.resize(zones().zones().size());
  is_touched_.resize(zones().zones().size());
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(world != nullptr);
  const auto network = NetworkOf(world);
  auto model = Make(settings, network, others);
  if (!model && network->roads().empty()) {
    return base::WrongInput("the world '" + world->name() + "' has no lane to put traffic on; a world with a road, or 0 vehicles, was expected");
  }
  return model;
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings, std::shared_ptr<const network::Network> network,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(network != nullptr);
  TrafficModel model(settings, std::make_shared<const Map>(std::move(network), settings.speed));
  if (settings.vehicles > 0 && model.map_->entries.empty()) {
    return base::WrongInput("the network '" + model.map_->network->name() + "' has no lane to put traffic on; drivable lanes, or 0 vehicles, were expected");
  }
  if (const auto status = lanes::CheckLights(model.map_->graph, model.map_->zones); !status) return status.error();
  model.FindColours();
  if (settings.vehicles > 0) model.PlaceAll(others);
  model.FindPoses();
  return model;
}

// Which of a track's links the agent takes as the n-th of its trip: by lot.
std::size_t TrafficModel::DrawLink(const Agent& agent, std::uint32_t id, std::uint32_t track, std::uint32_t link) const {
  const auto& next = graph()[track].next;
  const double draw = base::RandomUniform({settings_.seed, id, kDrawLink, agent.trip, link});
  return static_cast<std::size_t>(draw * static_cast<double>(next.size()));
}

void TrafficModel::Step(double dt_s, std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(dt_s > 0.0);
  bodies_.assign(others.begin(), others.end());
  for (const AgentPose& pose : poses_) {
    if (agents_[pose.id].is_struck) bodies_.push_back(FootprintOf(pose, traits_[pose.id]));
  }
  See(bodies_);
  Arbitrate(dt_s);
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  ChangeLanes(step_ns);
  std::vector<double> wanted(agents_.size(), 0.0);  // read the old state …
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (agents_[id].on_road) wanted[id] = Wanted(id);
  }
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {  // … write the new one
    if (!agents_[id].on_road) continue;
    Move(id, wanted[id], dt_s);
    Follow(id);
    if (AtTheEnd(id)) Leave(id);
  }
  SlideStruck(dt_s);
  Enter();
  time_ns_ += step_ns;
  FindColours();
  FindPoses();
}

// How far the point midway between the axles moves a metre of the odometer: the axles' middles keep to the path.
double TrafficModel::Advance(std::uint32_t id, double odometer_m) const {
  const Agent& agent = agents_[id];
  const double half_base = HalfBase(id);
  const PathFrame front = FrameAt(graph(), agent.path, odometer_m + half_base), rear = FrameAt(graph(), agent.path, odometer_m - half_base);
  return std::max(0.2, 0.5 * (front.stretch * front.ahead_W + rear.stretch * rear.ahead_W).norm());
}

// The odometer when that point has gone so far; where bends are tight, and beside a lane's middle, found by secants.
double TrafficModel::Moved(std::uint32_t id, double travel_m) const {
  const Agent& agent = agents_[id];
  const double rate = Advance(id, agent.o_m + 0.5 * travel_m);
  double odometer = agent.o_m + travel_m / rate;
  if (std::fabs(rate - 1.0) * travel_m < kGentle_m && agent.change.side == 0) return odometer;
  const auto middle = [&](double o) -> Eigen::Vector2d {
    return 0.5 * (FrameAt(graph(), agent.path, o + HalfBase(id)).p_W + FrameAt(graph(), agent.path, o - HalfBase(id)).p_W).head<2>();
  };
  const Eigen::Vector2d from = middle(agent.o_m);
  for (int turn = 0; turn < 4; ++turn) {
    const double gone = (middle(odometer) - from).norm();
    if (std::fabs(gone - travel_m) < 1e-5 || gone < 1e-9) break;
    odometer = agent.o_m + (odometer - agent.o_m) * std::clamp(travel_m / gone, 0.5, 2.0);
  }
  return odometer;
}

// Constant acceleration over the step; a car that comes to rest stays at rest.
void TrafficModel::Move(std::uint32_t id, double acceleration_mps2, double dt_s) {
  Agent& agent = agents_[id];
  const double before = agent.speed_mps;
  double travel = (before + 0.5 * acceleration_mps2 * dt_s) * dt_s;
  double after = before + acceleration_mps2 * dt_s;
  if (after < 0.0) {
    after = 0.0;
    travel = acceleration_mps2 < 0.0 ? -0.5 * before * before / acceleration_mps2 : 0.0;
  }
  agent.acceleration_mps2 = (after - before) / dt_s;
  agent.speed_mps = after;
  agent.driven_m += travel;
  if (travel > 0.0) agent.o_m = Moved(id, travel);
}

// The path grows under the front bumper and is forgotten behind the rear one.
void TrafficModel::Follow(std::uint32_t id) {
  Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m;
  while (true) {
    const Piece& last = agent.path.back();
    const lanes::Track& track = graph()[last.track];
    if (agent.o_m + half <= last.zero_m + track.length_m() || track.next.empty()) break;
    const lanes::Link& link = track.next[DrawLink(agent, id, last.track, agent.links)];
    agent.path.push_back(Onward(graph(), agent.path, link, agent.speed_mps));
    ++agent.links;
  }
  while (agent.path.size() > 1 && agent.path[1].begin_m < agent.o_m - half - 1.0) agent.path.erase(agent.path.begin());
}

bool TrafficModel::AtTheEnd(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const Piece& last = agent.path.back();
  const lanes::Track& track = graph()[last.track];
  return track.next.empty() && agent.o_m + 0.5 * traits_[id].length_m >= last.zero_m + track.length_m();
}

void TrafficModel::Save(base::StateWriter& writer) const {
  for (const Agent& agent : agents_) writer.Put("agent", agent);
  writer.Put("waiting", waiting_);
  writer.Put("next_grant", next_grant_);
  writer.Put("time_ns", time_ns_);
}

// A snapshot comes from outside: whatever it says, nothing is read beside the arrays.
void TrafficModel::Restore(base::StateReader& reader) {
  for (Agent& agent : agents_) reader.Get("agent", agent);
  reader.Get("waiting", waiting_);
  reader.Get("next_grant", next_grant_);
  reader.Get("time_ns", time_ns_);
  for (Agent& agent : agents_) {
    const auto tracks = graph().tracks().size();
    if (agent.entry >= tracks || std::any_of(agent.path.begin(), agent.path.end(), [&](const Piece& p) { return p.track >= tracks; })) agent = Agent();
  }
  std::erase_if(waiting_, [&](std::uint32_t id) { return id >= agents_.size(); });
  FindColours();
  FindPoses();
}

}  // namespace rodeira::traffic

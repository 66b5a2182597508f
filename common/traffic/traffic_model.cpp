// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/traffic_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/huge_pages.hpp"
#include "common/core/base/random.hpp"
#include "common/traffic/network/long_enough.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/perception/each_driving.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawLink = 103;
constexpr std::size_t kBendPrefetch = 6;  // agents ahead whose bends are prefetched
constexpr double kGentle_m = 3e-4;        // what a bend makes of the way of a step, and no more

}  // namespace

TrafficModel::TrafficModel(const TrafficSettings& settings, std::shared_ptr<const TrafficMap> map)
    : settings_(settings),
      map_(std::move(map)),
      agents_(settings.vehicles + settings.scripted.size()),
      occupants_(graph().tracks().size()),
      book_(zones().zones().size()),
      present_(graph().tracks().size()) {
  for (std::uint32_t id = 0; id < agents_.size(); ++id) traits_.push_back(TraitsOf(settings_, id));
  for (const AgentTraits& traits : traits_) longest_half_m_ = std::max(longest_half_m_, 0.5 * traits.length_m);
  if (!settings_.demand.flows.empty()) longest_half_m_ = 0.5 * LargestOf(settings_).length_m;
  if (settings_.threads > 1) pool_ = std::make_shared<base::ThreadPool>(settings_.threads);
  stretches_.resize(agents_.size());
  way_keys_.resize(agents_.size());
  below_.resize(agents_.size());
  ways_.assign(agents_.size(), 1);
  ahead_.resize(agents_.size());
  passages_.resize(agents_.size());
  known_.resize(agents_.size());
  reaches_.resize(agents_.size());
  wanted_.resize(agents_.size());
  hurries_.resize(agents_.size());
  missed_now_.resize(agents_.size());
  ends_.resize(agents_.size());
  moved_.resize(agents_.size());
  is_moved_.resize(agents_.size());
  leaves_.resize(agents_.size());
  bars_.assign(agents_.size(), kNoBarrier_m);
  at_entry_.resize(agents_.size());
  blocks_.resize(graph().tracks().size());
  facing_.resize(graph().tracks().size());
  is_overtaken_.resize(agents_.size());
  beside_.resize(agents_.size());
  passes_.resize(agents_.size());
  parts_.resize(graph().tracks().size());
  is_asked_.resize(2 * zones().zones().size());
  base::PreferHugePages(agents_);
  base::PreferHugePages(traits_);
  base::PreferHugePages(stretches_);
  base::PreferHugePages(way_keys_);
  base::PreferHugePages(below_);
  base::PreferHugePages(ahead_);
  base::PreferHugePages(passages_);
  base::PreferHugePages(moved_);
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(world != nullptr);
  const auto network = NetworkOf(world);
  auto model = Make(settings, network, others, world);
  if (!model && network->roads().empty()) {
    return base::WrongInput("the world '" + world->name() +
                            "' has no lane to put traffic on; a world with a road, or 0 vehicles, was expected");
  }
  return model;
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings,
                                              std::shared_ptr<const network::Network> network,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(network != nullptr);
  return Make(settings, network, others, nullptr);
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings,
                                              std::shared_ptr<const network::Network> network,
                                              std::span<const driver::Footprint> others,
                                              std::shared_ptr<const road::World> world) {
  const auto map = std::make_shared<TrafficMap>(std::move(network), settings);
  auto demand = Demand::Make(map->graph, map->marks, settings.demand);
  if (!demand) return demand.error();
  map->demand = std::move(demand).value();
  const double longest_m = LargestOf(settings).length_m;
  for (std::size_t i = 0; i < map->demand.flows().size(); ++i) {
    if (map->demand.flows()[i].track < 0) continue;
    const auto track = static_cast<std::uint32_t>(map->demand.flows()[i].track);
    if (!IsLongEnough(map->graph, track, longest_m)) {
      const FlowSettings& flow = settings.demand.flows[i];
      return base::WrongInput(fmt::format("the lane '{}' and the ways on from it are shorter than a vehicle; at least "
                                          "{:.1f} m were expected",
                                          flow.lane, longest_m),
                              flow.place);
    }
    map->LetEnter(track);
  }
  TrafficModel model(settings, map);
  if (settings.vehicles > 0 && model.map_->entries.empty()) {
    return base::WrongInput("the network '" + model.map_->network->name() +
                            "' has no lane to put traffic on; drivable lanes that are longer than a vehicle, or 0 "
                            "vehicles, were expected");
  }
  if (settings.pedestrians) {
    auto people = Pedestrians::Make(model.graph(), LargestOf(settings), *settings.pedestrians, settings.seed);
    if (!people) return people.error();
    model.people_ = std::move(people).value();
    model.yielding_.resize(model.agents_.size());
  }
  if (const auto status = lanes::CheckLights(model.map_->graph, model.map_->zones); !status) return status.error();
  model.FindColours();
  if (!settings.demand.flows.empty())
    model.BeginFlows();
  else if (settings.vehicles > 0)
    model.PlaceAll(others);
  if (settings.physics == Physics::kFull) {
    if (world == nullptr) world = WorldOf(model.map_->network);
    model.StartFull(world->MakeGround());
    if (settings.driver == DriverKind::kMotors) model.StartMotors();
  }
  model.FindPoses();
  return model;
}

const Route* TrafficModel::RouteOf(const Agent& agent) const {
  if (agent.flow < 0) return nullptr;
  const std::int64_t route = map_->demand.flows()[static_cast<std::size_t>(agent.flow)].route;
  return route < 0 ? nullptr : &map_->demand.route(route);
}

// How the agent goes on from a track: as its route says; without one, or where that cannot be reached any more, by lot.
const lanes::Link& TrafficModel::NextLink(std::uint32_t id, std::uint32_t track, Choice& choice) const {
  const Agent& agent = agents_[id];
  const auto& next = graph()[track].next;
  const Route* route = RouteOf(agent);
  std::optional<std::size_t> chosen = route != nullptr ? route->LinkOn(graph(), choice.leg, track) : std::nullopt;
  if (!chosen) {
    const double draw = base::RandomUniform({settings_.seed, id, kDrawLink, agent.trip, choice.link});
    const auto shares = map_->demand.Shares(track);
    if (shares.empty())
      chosen = static_cast<std::size_t>(draw * static_cast<double>(next.size()));
    else
      chosen = std::min<std::size_t>(
          static_cast<std::size_t>(std::upper_bound(shares.begin(), shares.end(), draw) - shares.begin()),
          next.size() - 1);
  }
  const lanes::Link& link = next[*chosen];
  ++choice.link;
  if (route != nullptr) choice.leg = route->LegOn(choice.leg, link.to);
  return link;
}

// How everybody holds his car during the step.
void TrafficModel::Decide(double dt_s) {
  if (!motors_.empty()) {
    GiveWay();
    EachDriving([&](std::uint32_t id) { DriveMotors(id, dt_s); });
    return;
  }
  if (people_) LookAtPeople(dt_s);
  Arbitrate(dt_s);
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  ChangeLanes(step_ns);
  Overtake(step_ns);
  EachDriving([&](std::uint32_t id) { wanted_[id] = Smoothed(id, Wanted(id), dt_s); });
  if (full_) EachDriving([&](std::uint32_t id) { DriveFull(id, wanted_[id], dt_s); });
}

void TrafficModel::Step(double dt_s, std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(dt_s > 0.0);
  bodies_.assign(others.begin(), others.end());
  for (const AgentPose& pose : poses_) {
    if (agents_[pose.id].is_struck) bodies_.push_back(FootprintOf(pose, traits_[pose.id]));
  }
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  See(bodies_);
  if (people_ || !motors_.empty()) LookAhead();  // else with what comes next, while an agent is in near memory
  Decide(dt_s);                                  // reads the old state …
  if (full_) full_->Step(dt_s, pool_.get());
  std::fill(is_moved_.begin(), is_moved_.end(), 0);
  std::fill(ends_.begin(), ends_.end(), 0);
  std::fill(missed_now_.begin(), missed_now_.end(), 0);
  EachDriving([&](std::uint32_t id) {  // … writes the new one
    FetchBend(id);
    if (full_)
      FollowFull(id, dt_s);
    else
      MovePlanar(id, wanted_[id], dt_s);
    missed_now_[id] = Follow(id);
    ends_[id] = AtTheEnd(id);
    is_moved_[id] = !ends_[id];
    if (!ends_[id]) {
      moved_[id] = PoseOf(id);
      const bool as_below = below_[id].turned && moved_[id].q_WB.coeffs() == below_[id].turned->coeffs();
      agents_[id].grade = as_below ? below_[id].grade : GradeOf(moved_[id].q_WB);
    }
    const auto& path = agents_[id].path;
    at_entry_[id] =
        std::any_of(path.begin(), path.end(), [&](const Piece& piece) { return map_->watched[piece.track]; });
  });
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    missed_ += missed_now_[id];
    if (ends_[id]) Leave(id);
  }
  SlideStruck(dt_s);
  if (people_) people_->Step(dt_s, time_ns_ + step_ns);
  Arrive(time_ns_ + step_ns);
  Enter();
  AppearAll();
  time_ns_ += step_ns;
  FindColours();
  FindPoses();
}

// The line of who soon moves in a bend lies in far memory where there are thousands of agents: first the track, then
// what that names.
void TrafficModel::FetchBend(std::size_t id) const {
  const auto bends = [&](std::size_t of) {
    return of < below_.size() && below_[of].track < graph().tracks().size() && !below_[of].straight;
  };
  constexpr std::size_t kLine_bytes = 64;
  if (const std::size_t later = id + 2 * kBendPrefetch; bends(later)) {
    const auto* curve = reinterpret_cast<const char*>(&graph()[below_[later].track].curve);
    for (std::size_t at = 0; at < sizeof(lanes::Curve); at += kLine_bytes) __builtin_prefetch(curve + at);
  }
  if (const std::size_t soon = id + kBendPrefetch; bends(soon)) {
    const Below& below = below_[soon];  // all that may be read of it: another thread may move it now
    graph()[below.track].curve.Fetch(0.5 *
                                     (std::max(0.0, below.plan.from_m) + std::min(below.length_m, below.plan.to_m)));
  }
}

// How far the point midway between the axles moves a metre of the odometer: the axles' middles keep to the path.
double TrafficModel::Advance(std::uint32_t id, double odometer_m) const {
  const double half_base = HalfBase(id);
  const PathFrame front = FrameOf(id, odometer_m + half_base), rear = FrameOf(id, odometer_m - half_base);
  return std::max(0.2, 0.5 * (front.stretch * front.ahead_W + rear.stretch * rear.ahead_W).norm());
}

// The odometer when that point has gone so far; where bends are tight, and beside a lane's middle, found by secants.
double TrafficModel::Moved(std::uint32_t id, double travel_m) const {
  const Agent& agent = agents_[id];
  if (StraightBelow(id) != nullptr) return agent.o_m + travel_m;
  const double rate = Advance(id, agent.o_m + 0.5 * travel_m);
  double odometer = agent.o_m + travel_m / rate;
  if (std::fabs(rate - 1.0) * travel_m < kGentle_m && agent.change.side == 0 && !agent.overtaking.active())
    return odometer;
  const auto middle = [&](double o) -> Eigen::Vector2d {
    return 0.5 * (FrameOf(id, o + HalfBase(id)).p_W + FrameOf(id, o - HalfBase(id)).p_W).head<2>();
  };
  const Eigen::Vector2d from = middle(agent.o_m);
  for (int turn = 0; turn < 4; ++turn) {
    const double gone = (middle(odometer) - from).norm();
    if (std::fabs(gone - travel_m) < 1e-5 || gone < 1e-9) break;
    odometer = agent.o_m + (odometer - agent.o_m) * std::clamp(travel_m / gone, 0.5, 2.0);
  }
  return odometer;
}

// The path grows under the front bumper and is forgotten behind the rear one. How many lanes for its route it has
// missed.
std::uint32_t TrafficModel::Follow(std::uint32_t id) {
  std::uint32_t missed = 0;
  Agent& agent = agents_[id];
  const double half = 0.5 * traits_[id].length_m;
  while (true) {
    const Piece& last = agent.path.back();
    if (agent.o_m + half <= last.zero_m + LengthOf(id, last.track) || !GoesOn(id, last.track)) break;
    const Route* route = RouteOf(agent);
    if (route != nullptr && route->MustChange(agent.leg, last.track)) ++missed;
    Choice choice{agent.links, agent.leg};
    const lanes::Link& link = NextLink(id, last.track, choice);
    agent.path.push_back(Onward(graph(), agent.path, link, agent.speed_mps));
    agent.links = choice.link, agent.leg = choice.leg;
    agent.seeks = false;
  }
  while (agent.path.size() > 1 && agent.path[1].begin_m < agent.o_m - half - 1.0) agent.path.erase(agent.path.begin());
  return missed;
}

bool TrafficModel::AtTheEnd(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const Piece& last = agent.path.back();
  return !GoesOn(id, last.track) && agent.o_m + 0.5 * traits_[id].length_m >= last.zero_m + LengthOf(id, last.track);
}

}  // namespace rodeira::traffic

// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/traffic/perception/each_driving.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kLongestPart_s = 0.25;
constexpr std::int64_t kLook_ns = 100'000'000;  // between two looks, at most

// Between two times at which all is looked for; 0: in every step.
std::int64_t LookEvery_ns(const TrafficSettings& settings) {
  return std::min<std::int64_t>(kLook_ns, std::llround(settings.decide_s * 1e9));
}

}  // namespace

TrafficData::TrafficData(const TrafficSettings& of, std::shared_ptr<const TrafficMap> on)
    : settings(of),
      map(std::move(on)),
      store(settings),
      seen(store.agents.size(), map->graph.tracks().size()),
      claimed(store.agents.size(), map->zones.zones().size()),
      step(store.agents.size(), map->graph.tracks().size(), settings.reaction_s > 0.0) {
  if (settings.threads > 1) pool = std::make_shared<base::ThreadPool>(settings.threads);
}

// Other vehicles, and agents that have been hit.
void Simulation::Observe(std::span<const driver::Footprint> others) {
  seen.bodies.assign(others.begin(), others.end());
  for (const AgentPose& pose : store.poses) {
    if (store.agents[pose.id].is_crashed) seen.bodies.push_back(FootprintOf(pose, store.traits[pose.id]));
  }
  observation.See(seen.bodies);
  // Else with what comes next, while a vehicle is in near memory.
  if (store.people || !store.motors.empty()) observation.FindLeaders();
}

// Writes where vehicles wait for people on foot, and which people may go.
void Simulation::LetPeopleCross(double dt_s) {
  if (store.people && store.motors.empty()) crosswalks.LookAtPeople(dt_s);
}

void Simulation::Reserve(double dt_s, std::int64_t turn_ns) {
  if (store.motors.empty()) right_of_way.Arbitrate(dt_s, turn_ns);
}

void Simulation::ChangeLanes(std::int64_t step_ns) {
  if (store.motors.empty()) lane_changes.ChangeLanes(step_ns);
}

void Simulation::Overtake(std::int64_t step_ns) {
  if (store.motors.empty()) overtaking.Overtake(step_ns);
}

// Whether leaders, reservations and lanes are looked for in this step. The times of it are those of the clock, so that
// roads which have nothing to do with one another do not change one another.
bool Simulation::LooksAnew(std::span<const driver::Footprint> others) const {
  const std::int64_t every_ns = LookEvery_ns(settings);
  if (every_ns <= 0 || store.people || !store.motors.empty() || !others.empty() || store.looked_ns < 0) return true;
  return store.time_ns / every_ns != store.looked_ns / every_ns ||
         std::ranges::any_of(store.poses, [&](const AgentPose& pose) { return store.agents[pose.id].is_crashed; });
}

// How much later that is done again, after a step in which it is.
std::int64_t Simulation::NextLook_ns(std::int64_t step_ns) const {
  const std::int64_t every_ns = LookEvery_ns(settings);
  if (every_ns <= step_ns || store.people || !store.motors.empty() || !seen.bodies.empty()) return step_ns;
  const std::int64_t left_ns = every_ns - store.time_ns % every_ns;
  return (left_ns + step_ns - 1) / step_ns * step_ns;
}

// Each driver goes on as it decided last, but for what cannot wait.
void Simulation::KeepOn(double dt_s) {
  EachDriving(pool.get(), store.agents, [&](std::uint32_t id) {
    tracks.LookBelow(id);
    decisions.KeepLeader(id);
  });
  if (settings.reaction_s > 0.0) reaction.Perceive();
  EachDriving(pool.get(), store.agents,
              [&](std::uint32_t id) { step.wanted[id] = acceleration.Smoothed(id, decisions.Kept(id), dt_s); });
  DriveCars(dt_s);
}

void Simulation::DriveCars(double dt_s) {
  if (!store.full) return;
  EachDriving(pool.get(), store.agents, [&](std::uint32_t id) { full_motion.DriveFull(id, step.wanted[id], dt_s); });
}

// How each driver holds the car during the step.
void Simulation::Accelerate(double dt_s, std::int64_t turn_ns) {
  if (!store.motors.empty()) {
    motors_driving.GiveWay();
    EachDriving(pool.get(), store.agents, [&](std::uint32_t id) { motors_driving.DriveMotors(id, dt_s); });
    return;
  }
  if (settings.reaction_s > 0.0) reaction.Perceive();
  const bool decides = settings.decide_s > 0.0;
  EachDriving(pool.get(), store.agents, [&](std::uint32_t id) {
    const double wanted = decides ? decisions.Wanted(id, turn_ns) : acceleration.Wanted(id);
    step.wanted[id] = acceleration.Smoothed(id, wanted, dt_s);
  });
  DriveCars(dt_s);
}

// At the end of its last lane a vehicle leaves, as does one that is to be removed; vehicles that have been hit slide.
void Simulation::LeaveOrSlide(double dt_s) {
  for (std::uint32_t id = 0; id < store.agents.size(); ++id) {
    store.missed += step.missed_now[id];
    if (step.ends[id]) entering.Leave(id);
  }
  RemoveRequested();
  crashes.StepCrashed(dt_s);
}

void Simulation::RemoveRequested() {
  if (step.removals.empty()) return;
  for (const std::uint32_t id : step.removals) {
    std::erase_if(store.appearing, [id](const SpawningVehicle& next) { return next.id == id; });
    if (step.ends[id]) {  // has just left, and does not enter again
      std::erase(store.waiting, id);
      continue;
    }
    step.is_moved[id] = 0;
    entering.Remove(id);
  }
  step.removals.clear();
  std::ranges::sort(step.leavers, {}, &Leaver::id);
}

// Vehicles of flows arrive, waiting ones enter, and a scenario's ones appear.
void Simulation::Enter(std::int64_t step_ns, bool looks) {
  arriving.Arrive(store.time_ns + step_ns);
  if (!looks) return;
  entering.Enter();
  appearing_vehicles.SpawnAll();
}

// What the next step, and others, see.
void Simulation::Show(std::int64_t step_ns) {
  store.time_ns += step_ns;
  store.light_holds.DropEnded(store.time_ns);
  signals.FindColours();
  body_poses.FindPoses();
}

void Simulation::Step(double dt_s, std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(dt_s > 0.0);
  step.leavers.clear();
  const double parts = std::ceil(dt_s / kLongestPart_s);
  if (parts <= 1.0) return StepPart(dt_s, others);
  for (double part = 0.0; part < parts; part += 1.0) StepPart(dt_s / parts, others);
  std::ranges::sort(step.leavers, {}, &Leaver::id);
}

// Perception and decisions.
void Simulation::Decide(double dt_s, std::span<const driver::Footprint> others) {
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  Observe(others);
  const bool every_step = store.looked_ns < 0 || store.looked_ns == store.time_ns - step_ns;
  const double since_s = every_step ? dt_s : 1e-9 * static_cast<double>(store.time_ns - store.looked_ns);
  const std::int64_t turn_ns = NextLook_ns(step_ns);
  LetPeopleCross(dt_s);
  Reserve(since_s, turn_ns);
  ChangeLanes(turn_ns);
  Overtake(turn_ns);
  Accelerate(dt_s, turn_ns);
  if (settings.decide_s > 0.0) store.looked_ns = store.time_ns;
}

void Simulation::StepPart(double dt_s, std::span<const driver::Footprint> others) {
  const std::int64_t step_ns = std::llround(dt_s * 1e9);
  const bool looks = LooksAnew(others);
  if (looks)
    Decide(dt_s, others);
  else
    KeepOn(dt_s);
  motion.Move(dt_s);  // up to here the old state is read, from here on the new one is written
  LeaveOrSlide(dt_s);
  if (store.people) store.people->Step(dt_s, store.time_ns + step_ns);
  Enter(step_ns, looks);
  Show(step_ns);
}

}  // namespace rodeira::traffic

#include "common/traffic/traffic_model.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"
#include "common/base/random.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint64_t kDrawJitter = 101;
constexpr std::uint64_t kDrawLane = 102;
constexpr double kStartJitter = 0.6;          // share of the spacing
constexpr double kStartClear_m = 15.0;        // from others, at the beginning
constexpr double kGentle_mps2 = 0.8;          // an entering car needs no harder braking than this
constexpr double kEnteringShare = 0.95;       // of the speed it wants

}  // namespace

TrafficModel::TrafficModel(const TrafficSettings& settings, std::shared_ptr<const road::World> world)
    : settings_(settings), world_(std::move(world)), agents_(settings.vehicles) {
  for (std::uint32_t id = 0; id < settings_.vehicles; ++id) traits_.push_back(TraitsOf(settings_, id));
  const auto roads = world_->roads();
  for (std::size_t r = 0; r < roads.size(); ++r) {
    for (const road::Lane& lane : roads[r].lanes()) {
      const driver::LanePath path(roads[r], lane.id);
      lanes_.push_back({path, driver::SpeedPlan(path, settings_.speed), static_cast<std::int32_t>(r), {}, {}});
    }
  }
}

base::Result<TrafficModel> TrafficModel::Make(const TrafficSettings& settings, std::shared_ptr<const road::World> world,
                                              std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(world != nullptr);
  TrafficModel model(settings, std::move(world));
  if (settings.vehicles > 0 && model.lanes_.empty()) {
    return base::WrongInput("the world '" + model.world_->name() + "' has no lane to put traffic on; a world with a road, or 0 vehicles, was expected");
  }
  if (settings.vehicles > 0) model.PlaceAll(model.BlocksOf(others));
  model.FindPoses();
  return model;
}

TrafficModel::Blocks TrafficModel::BlocksOf(std::span<const driver::Footprint> others) const {
  Blocks blocks(lanes_.size());
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    for (const driver::Footprint& other : others) {
      if (const auto span = lanes_[lane].path.SpanOf(other)) blocks[lane].push_back(*span);
    }
  }
  return blocks;
}

// Agents take turns at the lanes; on a lane they stand at even distances, jittered, no faster than their gaps allow.
void TrafficModel::PlaceAll(const Blocks& blocks) {
  const std::size_t lanes = lanes_.size();
  for (std::size_t l = 0; l < lanes; ++l) {
    Lane& lane = lanes_[l];
    const std::size_t count = (agents_.size() + lanes - 1 - l) / lanes;
    const double spacing = lane.path.length_m() / static_cast<double>(std::max<std::size_t>(1, count));
    double behind_m = 0.0;  // front bumper of the one behind
    for (std::size_t k = 0; k < count; ++k) {
      const auto id = static_cast<std::uint32_t>(l + k * lanes);
      Agent& agent = agents_[id];
      const AgentTraits& traits = traits_[id];
      agent.lane = static_cast<std::int32_t>(l);
      const double jitter = base::RandomUniform({settings_.seed, id, kDrawJitter}, -0.5, 0.5) * kStartJitter;
      const double middle = (static_cast<double>(k) + 0.5 + jitter) * spacing;
      const double half = 0.5 * traits.length_m;
      bool room = middle - half > behind_m + settings_.idm.standing_gap_m && middle - half > 0.0 && middle + half < lane.path.length_m();
      for (const driver::LaneSpan& block : blocks[l]) {
        room = room && (middle - half > block.front_m + kStartClear_m || middle + half < block.rear_m - kStartClear_m);
      }
      if (!room) {
        lane.waiting.push_back(id);
        continue;
      }
      agent.on_road = true;
      agent.d_m = middle;
      behind_m = middle + half;
      lane.order.push_back(id);
    }
    for (std::size_t place = lane.order.size(); place-- > 0;) {
      const std::uint32_t id = lane.order[place];
      double speed = Desired(l, id);
      if (place + 1 < lane.order.size()) {
        const std::uint32_t next = lane.order[place + 1];
        const double gap = agents_[next].d_m - agents_[id].d_m - 0.5 * (traits_[next].length_m + traits_[id].length_m);
        speed = std::min(speed, std::max(0.0, gap - traits_[id].idm.standing_gap_m) / traits_[id].idm.time_gap_s);
      }
      const Ahead block = BlockAhead(l, blocks, agents_[id].d_m, traits_[id]);
      if (block.any) speed = std::min(speed, std::max(0.0, block.gap_m - traits_[id].idm.standing_gap_m) / (2.0 * traits_[id].idm.time_gap_s));
      agents_[id].speed_mps = speed;
    }
  }
}

double TrafficModel::Desired(std::size_t lane, std::uint32_t id) const {
  return lanes_[lane].plan.At(agents_[id].d_m).speed_mps * traits_[id].speed_factor;
}

TrafficModel::Ahead TrafficModel::BlockAhead(std::size_t lane, const Blocks& blocks, double middle_m, const AgentTraits& traits) const {
  Ahead ahead;
  const double half_width = 0.5 * traits.width_m + settings_.side_margin_m;
  const double front = middle_m + 0.5 * traits.length_m;
  for (const driver::LaneSpan& block : blocks[lane]) {
    if (0.5 * (block.rear_m + block.front_m) <= middle_m || block.right_m > half_width || block.left_m < -half_width) continue;
    const double gap = block.rear_m - front;
    if (gap > settings_.sight_m || (ahead.any && gap >= ahead.gap_m)) continue;
    ahead = {gap, block.speed_mps, true};
  }
  return ahead;
}

// The acceleration of the agent at this place of the lane's order: the least of the plan, the car in front, what blocks.
double TrafficModel::Wanted(std::size_t lane, std::size_t place, const Blocks& blocks) const {
  const Lane& l = lanes_[lane];
  const std::uint32_t id = l.order[place];
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const double v = agent.speed_mps;
  const driver::SpeedPlan::Allowed allowed = l.plan.At(agent.d_m);
  const double planned = allowed.speed_mps * traits.speed_factor;
  const double limit = std::min(l.path.speed_limit_mps() * traits.speed_factor, agent.cap_mps);
  double wanted = std::min(driver::IdmFreeAcceleration(traits.idm, v, limit),
                           allowed.slope_1ps * traits.speed_factor * v + (planned - v) / settings_.tracking_s);
  if (planned > agent.cap_mps) wanted = std::min(wanted, (agent.cap_mps - v) / settings_.tracking_s);
  if (place + 1 < l.order.size()) {
    const std::uint32_t next = l.order[place + 1];
    const double gap = agents_[next].d_m - agent.d_m - 0.5 * (traits_[next].length_m + traits.length_m);
    if (gap < settings_.sight_m) wanted = std::min(wanted, driver::IdmAcceleration(traits.idm, v, limit, gap, agents_[next].speed_mps));
  }
  const Ahead block = BlockAhead(lane, blocks, agent.d_m, traits);
  if (block.any) wanted = std::min(wanted, driver::IdmAcceleration(traits.idm, v, limit, block.gap_m, block.speed_mps));
  wanted = std::clamp(wanted, -traits.idm.hardest_mps2, traits.idm.acceleration_mps2);
  return agent.brake_mps2 > 0.0 ? std::min(wanted, -agent.brake_mps2) : wanted;
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
  agent.d_m += travel;
  agent.driven_m += travel;
}

std::int32_t TrafficModel::DrawLane(std::uint32_t id, std::uint32_t trip) const {
  const double draw = base::RandomUniform({settings_.seed, id, kDrawLane, trip});
  return static_cast<std::int32_t>(draw * static_cast<double>(lanes_.size()));
}

void TrafficModel::Leave(std::size_t lane) {
  auto& order = lanes_[lane].order;
  while (!order.empty()) {
    const std::uint32_t id = order.back();
    Agent& agent = agents_[id];
    if (agent.d_m + 0.5 * traits_[id].length_m < lanes_[lane].path.length_m()) return;
    order.pop_back();
    agent.on_road = false;
    agent.speed_mps = 0.0;
    agent.acceleration_mps2 = 0.0;
    Release(id);
    ++agent.trip;
    agent.lane = DrawLane(id, agent.trip);
    lanes_[static_cast<std::size_t>(agent.lane)].waiting.push_back(id);
  }
}

// The first who waits enters with its rear bumper at the lane's beginning, at its own speed or at that of the car ahead,
// once the gap bears it.
void TrafficModel::Enter(std::size_t lane, const Blocks& blocks) {
  Lane& l = lanes_[lane];
  if (l.waiting.empty()) return;
  const std::uint32_t id = l.waiting.front();
  const AgentTraits& traits = traits_[id];
  const double middle = 0.5 * traits.length_m;
  const double limit = l.path.speed_limit_mps() * traits.speed_factor;
  double speed = kEnteringShare * l.plan.At(middle).speed_mps * traits.speed_factor;
  Ahead ahead = BlockAhead(lane, blocks, middle, traits);
  for (const driver::LaneSpan& block : blocks[lane]) {
    if (block.rear_m < traits.length_m + traits.idm.standing_gap_m && block.front_m > 0.0) return;  // the place is taken
  }
  if (!l.order.empty()) {
    const std::uint32_t next = l.order.front();
    const double gap = agents_[next].d_m - 0.5 * traits_[next].length_m - traits.length_m;
    if (!ahead.any || gap < ahead.gap_m) ahead = {gap, agents_[next].speed_mps, true};
  }
  if (ahead.any) {
    const auto safe = [&](double v) {
      return ahead.gap_m > 2.0 * traits.idm.standing_gap_m && ahead.gap_m >= traits.idm.standing_gap_m + v * traits.idm.time_gap_s &&
             driver::IdmAcceleration(traits.idm, v, limit, ahead.gap_m, ahead.speed_mps) > -kGentle_mps2;
    };
    if (!safe(speed)) speed = std::clamp(ahead.speed_mps, 0.0, speed);
    if (!safe(speed)) return;
  }
  l.waiting.erase(l.waiting.begin());
  l.order.insert(l.order.begin(), id);
  Agent& agent = agents_[id];
  agent.on_road = true;
  agent.d_m = middle;
  agent.speed_mps = speed;
}

void TrafficModel::Step(double dt_s, std::span<const driver::Footprint> others) {
  RODEIRA_ASSERT(dt_s > 0.0);
  const Blocks blocks = BlocksOf(others);
  std::vector<double> wanted(agents_.size(), 0.0);  // read the old state …
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
    for (std::size_t place = 0; place < lanes_[lane].order.size(); ++place) {
      wanted[lanes_[lane].order[place]] = Wanted(lane, place, blocks);
    }
  }
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {  // … write the new one
    if (agents_[id].on_road) Move(id, wanted[id], dt_s);
  }
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) Leave(lane);
  for (std::size_t lane = 0; lane < lanes_.size(); ++lane) Enter(lane, blocks);
  FindPoses();
}

}  // namespace rodeira::traffic

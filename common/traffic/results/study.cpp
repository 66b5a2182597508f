// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/right_of_way/queueing.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::size_t kIncidents = 20;
constexpr double kMoving_mps = 0.5;
constexpr double kHard_mps2 = 3.0;
constexpr double kOffLaneTolerance_m = 1e-3;
constexpr double kWidest_m = 4.0, kHalfTyre_m = 0.1;
constexpr double kSmooth_mps3 = 3.0 * (1.0 + 1e-6), kLateral_mps2 = 3.0,
                 kYaw_radps2 = 200.0 * base::kPi / 180.0;  // what is told of

class Watcher {
 public:
  Watcher(const network::Network& network, const StudySettings& settings)
      : network_(network),
        settings_(settings),
        stands_s_(settings.traffic.vehicles + settings.traffic.scripted.size(), 0.0),
        with_room_s_(stands_s_),
        turning_(stands_s_.size()),
        hurried_(stands_s_.size(), 0) {}

  StudyResult& result() { return result_; }

  // After every step: distances against speeds.
  void Compare(const TrafficModel& model, double time_s) {
    time_s_ = time_s;
    std::size_t k = 0, same = 0;
    for (const AgentPose& pose : model.poses()) {
      result_.fuel_mg += result_.steps > 0 ? model.agent(pose.id).fuel_mgps * settings_.step_s : 0.0;
      while (k < before_.size() && before_[k].id < pose.id) ++k;
      result_.vehicle_s += settings_.step_s;
      if (k >= before_.size() || before_[k].id != pose.id || before_[k].trip != pose.trip) continue;
      ++same;
      Hurry(model, pose);
      if (settings_.feels) Feel(model, pose, before_[k]);
      const double moved = (pose.p_WB_W - before_[k].p_WB_W).head<2>().norm();
      const double told = 0.5 * (pose.speed_mps + before_[k].speed_mps) * settings_.step_s;
      result_.driven_km += 1e-3 * moved;
      const double error = std::fabs(moved - told);
      if (error > 1e-3) Tell("moved {:.4f} m instead of {:.4f} m", pose, moved, told);
      result_.worst_step_m = std::max(result_.worst_step_m, error);
      result_.hardest_any_mps2 = std::max(result_.hardest_any_mps2, -pose.acceleration_mps2);
      if (model.agent(pose.id).driving.brake <= 0.0) continue;  // a hill that the engine is too weak for
      if (pose.acceleration_mps2 < -kHard_mps2 && before_[k].acceleration_mps2 >= -kHard_mps2)
        Tell("brakes at {:.2f} m/s2", pose, -pose.acceleration_mps2);
      result_.hardest_mps2 = std::max(result_.hardest_mps2, -pose.acceleration_mps2);
      if (pose.speed_mps < kMoving_mps) continue;
      const dynamics::BicycleSettings& car = CarOfBody(model.traits(pose.id).body);
      result_.foot_mps2 =
          std::max(result_.foot_mps2, model.agent(pose.id).driving.brake * FullBrake_N(car) / car.body.mass_kg);
    }
    if (result_.steps == 0)
      result_.began = static_cast<std::int64_t>(model.poses().size());
    else
      result_.entered += static_cast<std::int64_t>(model.poses().size() - same),
          result_.left += static_cast<std::int64_t>(before_.size() - same);
    before_ = model.poses();
    ++result_.steps;
  }

  // Once told until it is over.
  void Hurry(const TrafficModel& model, const AgentPose& pose) {
    const bool hurries = model.Hurries(pose.id);
    if (hurries) ++result_.hurried_steps;
    if (hurries && hurried_[pose.id] == 0) Tell("hurries", pose);
    hurried_[pose.id] = hurries ? 1 : 0;
  }

  // From one step to the next; a heading is that of the middle between the axles.
  void Feel(const TrafficModel& model, const AgentPose& pose, const AgentPose& before) {
    Turning& turning = turning_[pose.id];
    const bool goes_on = turning.trip == static_cast<std::int64_t>(pose.trip);
    const auto heading = [](const AgentPose& at) {
      const Eigen::Vector3d forward = at.q_WB * Eigen::Vector3d::UnitX();
      return std::atan2(forward.y(), forward.x());
    };
    const double rate = std::remainder(heading(pose) - heading(before), 2.0 * base::kPi) / settings_.step_s;
    const double jerk = std::fabs(pose.acceleration_mps2 - before.acceleration_mps2) / settings_.step_s,
                 lateral = std::fabs(pose.speed_mps * rate);
    double& worst = model.Hurries(pose.id) ? result_.emergency_jerk_mps3 : result_.planned_jerk_mps3;
    if (jerk > worst && jerk > kSmooth_mps3) Tell("jerks by {:.2f} m/s3", pose, jerk);
    if (lateral > result_.lateral_mps2 && lateral > kLateral_mps2)
      Tell("is pressed sideways by {:.2f} m/s2", pose, lateral);
    worst = std::max(worst, jerk);
    result_.lateral_mps2 = std::max(result_.lateral_mps2, lateral);
    if (goes_on) {
      const double yaw = std::fabs(rate - turning.rate_radps) / settings_.step_s;
      if (yaw > result_.yaw_radps2 && yaw > kYaw_radps2) Tell("yaws by {:.2f} rad/s2", pose, yaw);
      result_.yaw_radps2 = std::max(result_.yaw_radps2, yaw);
    }
    turning = {pose.trip, rate};
  }

  void Look(const TrafficModel& model) {
    Contacts(model);
    for (const AgentPose& pose : model.poses()) {
      const auto place = network_.Locate(pose.p_WB_W.x(), pose.p_WB_W.y(), pose.p_WB_W.z(), &hint_);
      const network::Lane* lane = place ? network_.Find(place->lane) : nullptr;
      if (lane == nullptr || place->distance_m > kOffLaneTolerance_m || !network::IsDrivable(lane->type)) {
        ++result_.off_lane;
        Tell("off its lane ({} m)", pose, place ? place->distance_m : -1.0);
      }
      LookAtWheels(model, pose);
      double& stands = stands_s_[pose.id];
      double& with_room = with_room_s_[pose.id];
      if (pose.speed_mps > kStandstill_mps) {
        stands = with_room = 0.0;
        continue;
      }
      stands += settings_.watch_s;
      if (model.RoomAhead(pose.id)) with_room += settings_.watch_s;
      result_.standing_s += settings_.watch_s;
      if (stands > result_.longest_stand_s) result_.longest_stand_s = stands, result_.longest_stand_id = pose.id;
      if (with_room > result_.longest_with_room_s)
        result_.longest_with_room_s = with_room, result_.longest_with_room_id = pose.id;
    }
  }

 private:
  struct Turning {
    std::int64_t trip = -1;
    double rate_radps = 0.0;
  };

  // On a drivable lane, or a shoulder or the like; where roads lie over one another, of any of them.
  bool IsForVehicles(const TrafficModel& model, const Eigen::Vector3d& p_W) {
    const auto place = network_.Locate(p_W.x(), p_W.y(), p_W.z(), &hint_);
    const network::Lane* lane = place ? network_.Find(place->lane) : nullptr;
    if (lane != nullptr && place->distance_m <= kOffLaneTolerance_m &&
        (network::IsDrivable(lane->type) || lane->type == network::LaneType::kShoulder))
      return true;
    for (const lanes::Graph::Beside& beside : model.graph().TracksAt(p_W.head<2>(), kWidest_m)) {
      const lanes::Curve& curve = model.graph()[beside.track].curve;
      if (std::fabs(beside.foot.offset_m) <= 0.5 * curve.WidthAt(beside.foot.d_m) + kOffLaneTolerance_m &&
          std::fabs(curve.At(beside.foot.d_m).p_W.z() - p_W.z()) < network::Network::kLevel_m)
        return true;
    }
    return false;
  }

  void LookAtWheels(const TrafficModel& model, const AgentPose& pose) {
    const AgentTraits& traits = model.traits(pose.id);
    for (const double along : {-0.5, 0.5}) {
      for (const double aside : {-1.0, 1.0}) {
        const Eigen::Vector3d wheel_W =
            pose.p_WB_W +
            pose.q_WB * Eigen::Vector3d(along * traits.wheelbase_m, aside * (0.5 * traits.width_m - kHalfTyre_m), 0.0);
        if (IsForVehicles(model, wheel_W)) continue;
        ++result_.wheels_off;
        Tell("has a wheel off the road, at ({:.2f}, {:.2f})", pose, wheel_W.x(), wheel_W.y());
      }
    }
  }

  template <class... Values>
  void Tell(const char* what, const AgentPose& pose, Values... values) {
    if (result_.incidents.size() >= kIncidents) return;
    result_.incidents.push_back(
        fmt::format("{:.2f} s: car {} on road '{}', lane {}, at ({:.2f}, {:.2f}), {:.2f} m/s: ", time_s_, pose.id,
                    network_.roads()[static_cast<std::size_t>(pose.road)].id(), pose.lane, pose.p_WB_W.x(),
                    pose.p_WB_W.y(), pose.speed_mps) +
        fmt::format(fmt::runtime(what), values...));
  }

  void Contacts(const TrafficModel& model) {
    constexpr double kCell_m = 12.0;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<const AgentPose*>> cells;
    for (const AgentPose& pose : model.poses())
      cells[{std::llround(pose.p_WB_W.x() / kCell_m), std::llround(pose.p_WB_W.y() / kCell_m)}].push_back(&pose);
    std::set<std::pair<std::uint32_t, std::uint32_t>> now;
    for (const auto& [cell, here] : cells) {
      for (std::int64_t dx = -1; dx <= 1; ++dx) {
        for (std::int64_t dy = -1; dy <= 1; ++dy) {
          const auto beside = cells.find({cell.first + dx, cell.second + dy});
          if (beside == cells.end()) continue;
          for (const AgentPose* a : here) {
            for (const AgentPose* b : beside->second) {
              if (a->id >= b->id || std::fabs(a->p_WB_W.z() - b->p_WB_W.z()) > network::Network::kLevel_m) continue;
              if (driver::Overlap(FootprintOf(*a, model.traits(a->id)), FootprintOf(*b, model.traits(b->id))))
                now.insert({a->id, b->id});
            }
          }
        }
      }
    }
    for (const auto& pair : now) {
      if (touching_.count(pair) != 0) continue;
      ++result_.collisions;
      const auto a = std::find_if(model.poses().begin(), model.poses().end(),
                                  [&](const AgentPose& p) { return p.id == pair.first; });
      const auto b = std::find_if(model.poses().begin(), model.poses().end(),
                                  [&](const AgentPose& p) { return p.id == pair.second; });
      Tell("touches car {} on road '{}', lane {}, {:.2f} m/s", *a, b->id,
           network_.roads()[static_cast<std::size_t>(b->road)].id(), b->lane, b->speed_mps);
    }
    touching_ = std::move(now);
  }

  const network::Network& network_;
  const StudySettings& settings_;
  StudyResult result_;
  double time_s_ = 0.0;
  network::Hint hint_;
  std::vector<double> stands_s_, with_room_s_;  // by agent: its stand as yet, and how much of it with room ahead
  std::vector<Turning> turning_;                // by agent
  std::vector<std::uint8_t> hurried_;           // by agent: in the step before
  std::vector<AgentPose> before_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> touching_;
};

base::Result<StudyResult> Study(const StudySettings& settings, base::Result<TrafficModel> made,
                                const std::function<void(const StudyMoment&)>& watch) {
  if (!made) return made.error();
  TrafficModel model = std::move(made).value();
  Watcher watcher(model.graph().network(), settings);
  const auto steps = static_cast<std::int64_t>(std::llround(settings.duration_s / settings.step_s));
  const auto every = std::max<std::int64_t>(1, std::llround(settings.watch_s / settings.step_s));
  std::optional<LaneStatistics> lanes;
  std::optional<LaneIntervals> intervals;
  const auto steps_of = [&](double time_s) {
    return static_cast<std::int64_t>(std::llround(time_s / settings.step_s));
  };
  const std::int64_t warm = steps_of(settings.warm_s),
                     interval = settings.every_s > 0.0 ? std::max<std::int64_t>(1, steps_of(settings.every_s)) : 0;
  const auto begin = [&] {
    lanes.emplace(model, settings.cell_m);
    if (interval > 0) intervals.emplace(*lanes, model.graph().tracks().size(), settings.warm_s);
  };
  if (settings.cell_m > 0.0 && warm == 0) begin();
  for (std::int64_t k = 0; k <= steps; ++k) {
    if (k > 0) {
      if (settings.cell_m > 0.0 && !lanes && k > warm) begin();
      model.Step(settings.step_s, {});
      if (lanes) lanes->Add(model, settings.step_s);
    }
    watcher.Compare(model, static_cast<double>(k) * settings.step_s);
    const auto note = [&] {
      if (intervals && k > warm && (k - warm) % interval == 0) intervals->Note(*lanes);
    };
    if (k % every != 0) {
      note();
      continue;
    }
    watcher.Look(model);
    if (lanes) {
      lanes->LookAtQueues(model);
      if (intervals) intervals->LookAtQueues(*lanes);
    }
    note();
    if (watch) watch({static_cast<double>(k) * settings.step_s, model});
  }
  if (intervals && steps > warm && (steps - warm) % interval != 0) intervals->Note(*lanes);
  StudyResult result = watcher.result();
  result.steps = steps;
  result.lanes = std::move(lanes);
  result.intervals = std::move(intervals);
  result.on_road = model.on_road();
  result.waiting = model.waiting();
  for (std::uint32_t id = 0; id < model.vehicles(); ++id) result.arrivals += model.agent(id).trip;
  return result;
}

}  // namespace

base::Result<StudyResult> RunStudy(const StudySettings& settings, std::shared_ptr<const network::Network> network,
                                   const std::function<void(const StudyMoment&)>& watch) {
  return Study(settings, TrafficModel::Make(settings.traffic, std::move(network), {}), watch);
}

base::Result<StudyResult> RunStudy(const StudySettings& settings, const std::shared_ptr<const road::World>& world,
                                   const std::function<void(const StudyMoment&)>& watch) {
  const driver::Footprint clear = KeptClear(*world);
  return Study(settings, TrafficModel::Make(settings.traffic, world, {&clear, 1}), watch);
}

}  // namespace rodeira::traffic

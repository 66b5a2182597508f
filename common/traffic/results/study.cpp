// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/traffic/check/checker.hpp"
#include "common/traffic/motion/car_of.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/right_of_way/queueing.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMoving_mps = 0.5;
constexpr double kHard_mps2 = 3.0;
constexpr double kMoved_m = 1e-3, kShortStep_s = 0.1, kHardest_mps2 = 8.0;
constexpr double kSmooth_mps3 = 3.0 * (1.0 + 1e-6), kLateral_mps2 = 3.0,
                 kYaw_radps2 = 200.0 * base::kPi / 180.0;  // what is told of

// What is counted from the published poses whether or not anything is checked.
class Watcher {
 public:
  Watcher(const TrafficModel& model, const StudySettings& settings, Incidents& incidents)
      : settings_(settings),
        incidents_(incidents),
        stands_s_(model.vehicles(), 0.0),
        with_room_s_(model.vehicles(), 0.0),
        turning_(settings.feels ? model.vehicles() : 0),
        hurried_(model.vehicles(), 0),
        before_(model.vehicles()) {
    for (std::uint32_t body = 0; body < kBodies; ++body) {
      const dynamics::BicycleSettings& car = CarOfBody(body);
      full_brake_mps2_[body] = FullBrake_N(car) / car.body.mass_kg;
    }
  }

  StudyResult& result() { return result_; }

  // After every step: distances against speeds.
  void Compare(const TrafficModel& model, double time_s) {
    time_s_ = time_s;
    for (const Leaver& leaver : model.leavers()) ++result_.left_because[static_cast<std::size_t>(leaver.reason)];
    std::int64_t same = 0;
    for (const AgentPose& pose : model.poses()) {
      result_.fuel_mg += result_.steps > 0 ? model.agent(pose.id).fuel_mgps * settings_.step_s : 0.0;
      result_.vehicle_s += result_.steps > 0 ? settings_.step_s : 0.0;
      Before& before = before_[pose.id];
      const Before was = before;
      before = {pose.p_WB_W.head<2>(), pose.speed_mps, pose.acceleration_mps2, result_.steps, pose.trip};
      const double was_heading_rad = settings_.feels ? TakeHeading(pose) : 0.0;
      if (was.step != result_.steps - 1 || was.trip != pose.trip) continue;
      ++same;
      Hurry(model, pose);
      if (settings_.feels) Feel(model, pose, was.acceleration_mps2, was_heading_rad);
      const double moved = (pose.p_WB_W.head<2>() - was.p_W).norm();
      const double told = 0.5 * (pose.speed_mps + was.speed_mps) * settings_.step_s;
      const double error = std::fabs(moved - told);
      if (error > Untold_m()) Tell("moved {:.4f} m instead of {:.4f} m", pose, moved, told);
      result_.worst_step_m = std::max(result_.worst_step_m, error);
      result_.max_deceleration_any_mps2 = std::max(result_.max_deceleration_any_mps2, -pose.acceleration_mps2);
      const double brake = model.agent(pose.id).driving.brake;
      if (brake <= 0.0) continue;  // a hill that the engine is too weak for
      if (pose.acceleration_mps2 < -kHard_mps2 && was.acceleration_mps2 >= -kHard_mps2)
        Tell("brakes at {:.2f} m/s2", pose, -pose.acceleration_mps2);
      result_.max_deceleration_mps2 = std::max(result_.max_deceleration_mps2, -pose.acceleration_mps2);
      if (pose.speed_mps < kMoving_mps) continue;
      result_.foot_mps2 = std::max(result_.foot_mps2, brake * full_brake_mps2_[model.traits(pose.id).body]);
    }
    const auto now = static_cast<std::int64_t>(model.poses().size());
    if (result_.steps == 0)
      result_.began = now;
    else
      result_.entered += now - same, result_.left += there_ - same;
    there_ = now;
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
  void Feel(const TrafficModel& model, const AgentPose& pose, double was_mps2, double was_heading_rad) {
    Turning& turning = turning_[pose.id];
    const bool goes_on = turning.trip == static_cast<std::int64_t>(pose.trip);
    const double rate = std::remainder(turning.heading_rad - was_heading_rad, 2.0 * base::kPi) / settings_.step_s;
    const double jerk = std::fabs(pose.acceleration_mps2 - was_mps2) / settings_.step_s,
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
    turning.trip = pose.trip, turning.rate_radps = rate;
  }

  // Every watch_s: how long vehicles stand.
  void Stand(const TrafficModel& model) {
    for (const AgentPose& pose : model.poses()) {
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
  // What a vehicle's way may differ by from its mean speed: in a long step that may change in between.
  double Untold_m() const {
    return settings_.step_s <= kShortStep_s ? kMoved_m
                                            : kMoved_m + kHardest_mps2 * settings_.step_s * settings_.step_s / 4.0;
  }

  struct Turning {
    std::int64_t trip = -1;
    double rate_radps = 0.0, heading_rad = 0.0;
  };
  // A vehicle as it was seen last.
  struct Before {
    Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
    double speed_mps = 0.0, acceleration_mps2 = 0.0;
    std::int64_t step = -2;
    std::uint32_t trip = 0;
  };

  // Notes its heading; returns that of the step before.
  double TakeHeading(const AgentPose& pose) {
    const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
    return std::exchange(turning_[pose.id].heading_rad, std::atan2(forward.y(), forward.x()));
  }

  template <class... Values>
  void Tell(const char* what, const AgentPose& pose, Values... values) {
    incidents_.Tell(time_s_, pose, what, values...);
  }

  const StudySettings& settings_;
  Incidents& incidents_;
  StudyResult result_;
  double time_s_ = 0.0;
  std::vector<double> stands_s_, with_room_s_;  // by agent: its stand as yet, and how much of it with room ahead
  std::vector<Turning> turning_;                // by agent
  std::vector<std::uint8_t> hurried_;           // by agent: in the step before
  std::vector<Before> before_;                  // by agent
  std::int64_t there_ = 0;                      // on the road in the step before
  std::array<double, kBodies> full_brake_mps2_{};
};

base::Result<StudyResult> Study(const StudySettings& settings, base::Result<TrafficModel> made,
                                const std::function<void(const StudyMoment&)>& watch) {
  if (!made) return made.error();
  TrafficModel model = std::move(made).value();
  Incidents incidents(model.graph().network());
  Watcher watcher(model, settings, incidents);
  std::optional<Checker> checker;
  if (settings.checks) checker.emplace(model);
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
    if (checker) checker->Observe(model, static_cast<double>(k) * settings.step_s, incidents);
    watcher.Stand(model);
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
  result.incidents = incidents.sentences();
  if (checker) {
    const CheckCounts& found = checker->counts();
    result.checked = true;
    result.collisions = found.collisions, result.reds = found.reds;
    result.off_lane = found.off_lane, result.wheels_off = found.wheels_off;
  }
  result.lanes = std::move(lanes);
  result.intervals = std::move(intervals);
  result.on_road = model.on_road();
  result.waiting = model.waiting();
  for (std::uint32_t id = 0; id < model.vehicles(); ++id) {
    result.arrivals += model.agent(id).trip;
    result.driven_km += 1e-3 * model.agent(id).driven_m;
  }
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

// SPDX-License-Identifier: Apache-2.0
#include "nodes/traffic/traffic_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/traffic/network/road_network.hpp"
#include "common/traffic/network/tight_bends.hpp"
#include "common/traffic/pedestrians/pedestrians.hpp"
#include "common/traffic/place_orders.hpp"
#include "common/traffic/signals/map_lights.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/road/map_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/traffic_map/heights.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/traffic/event_check.hpp"
#include "nodes/traffic/starts.hpp"
#include "nodes/traffic/traffic_requests.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

float Single(double value) { return static_cast<float>(value); }

msg::TrafficAgent AgentAt(std::uint32_t id, std::uint32_t trip, const Eigen::Vector3d& p_W) {
  msg::TrafficAgent out;
  out.id(id);
  out.trip(trip);
  out.position_x_m(p_W.x());
  out.position_y_m(p_W.y());
  out.position_z_m(p_W.z());
  return out;
}

msg::TrafficAgent ToMessage(const traffic::AgentPose& pose, const traffic::AgentTraits& traits, std::uint32_t lights) {
  const Eigen::Matrix3d rotation = pose.q_WB.toRotationMatrix();
  msg::TrafficAgent out = AgentAt(pose.id, pose.trip, pose.p_WB_W);
  out.heading_rad(Single(std::atan2(rotation(1, 0), rotation(0, 0))));
  out.pitch_rad(Single(std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0))));
  out.roll_rad(Single(std::atan2(rotation(2, 1), rotation(2, 2))));
  out.speed_mps(pose.speed_mps);
  out.acceleration_mps2(Single(pose.acceleration_mps2));
  out.length_m(Single(traits.length_m));
  out.width_m(Single(traits.width_m));
  out.height_m(Single(traits.height_m));
  out.wheelbase_m(Single(traits.wheelbase_m));
  out.wheel_radius_m(Single(traits.wheel_radius_m));
  out.steer_rad(Single(pose.steer_rad));
  out.wheel_spin_rad(Single(pose.wheel_spin_rad));
  out.colour_rgb(traits.colour_rgb);
  out.kind(static_cast<std::uint32_t>(traits.kind));
  out.lights(lights);
  return out;
}

// Level, with no lights; the wheel that its legs go by turns once in two steps.
msg::TrafficAgent ToMessage(const traffic::PersonPose& pose) {
  constexpr std::uint32_t kPedestrian = 4;  // traffic.idl
  msg::TrafficAgent out = AgentAt(pose.id, pose.trip, pose.p_W);
  out.heading_rad(Single(pose.heading_rad));
  out.speed_mps(pose.speed_mps);
  out.length_m(Single(traffic::Pedestrians::kLength_m));
  out.width_m(Single(traffic::Pedestrians::kWidth_m));
  out.height_m(Single(pose.height_m));
  out.wheelbase_m(Single(traffic::Pedestrians::kLength_m));
  out.wheel_radius_m(Single(traffic::Pedestrians::kStrideRadius_m));
  out.wheel_spin_rad(Single(pose.stride_rad));
  out.colour_rgb(pose.colour_rgb);
  out.kind(kPedestrian);
  return out;
}

msg::TrafficDetail ToMessage(const traffic::AgentDetail& detail) {
  constexpr double kKilograms = 1e-6;  // a milligram
  msg::TrafficDetail out;
  out.id(detail.id);
  out.throttle(Single(detail.driving.throttle));
  out.brake(Single(detail.driving.brake));
  out.clutch(Single(detail.driving.clutch));
  out.engine_speed_radps(Single(detail.driving.engine_radps));
  out.fuel_rate_kgps(Single(kKilograms * detail.fuel_mgps));
  out.fuel_used_kg(Single(kKilograms * detail.fuel_used_mg));
  out.target_speed_mps(Single(detail.target_mps));
  out.target_x_m(Single(detail.target_W.x()));
  out.target_y_m(Single(detail.target_W.y()));
  out.path_heading_rad(Single(detail.path_heading_rad));
  out.look_ahead_x_m(Single(detail.look_ahead_W.x()));
  out.look_ahead_y_m(Single(detail.look_ahead_W.y()));
  out.gear(detail.driving.gear);
  return out;
}

// The rectangle of a published car; numbers of cars lie beyond those of agents.
driver::Footprint FootprintOf(const msg::VehicleState& in, std::uint32_t id) {
  const auto& q = in.attitude_wb();
  const double heading = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  const auto length_m = static_cast<double>(in.length_m());
  const double middle = static_cast<double>(in.front_m()) - 0.5 * length_m;
  const double along = std::cos(heading) * in.velocity_w_mps().x() + std::sin(heading) * in.velocity_w_mps().y();
  return {id,
          in.position_w_m().x() + middle * std::cos(heading),
          in.position_w_m().y() + middle * std::sin(heading),
          heading,
          along,
          length_m,
          static_cast<double>(in.width_m())};
}

class TrafficNode final : public lockstep::Node {
 public:
  // stream: by which it is a partner in collisions.
  TrafficNode(std::string name, lockstep::SourceIndex stream, traffic::TrafficModel model, bool publishes_answers)
      : name_(std::move(name)),
        stream_(stream),
        model_(std::move(model)),
        requests_(name_),
        publishes_answers_(publishes_answers) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    Publish(outbox, true);
    return {};
  }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    constexpr std::uint32_t kFirstCar = 1'000'000;
    others_.clear();
    for (const lockstep::Sample& sample : inbox.All(topics::kVehicleState)) {
      const auto state = idl::Decode<msg::VehicleState>(*sample.payload);
      if (!state) return state.error();
      others_.push_back(FootprintOf(state.value(), kFirstCar + sample.source()));
    }
    if (inbox.Has(topics::kCollisions)) {
      for (const lockstep::Sample& sample : inbox.All(topics::kCollisions)) {
        if (auto status = TakeHits(sample); !status) return status;
      }
    }
    if (inbox.Has(topics::kScenarioEvents)) {
      for (const lockstep::Sample& sample : inbox.All(topics::kScenarioEvents)) {
        if (auto status = ApplyScenarioEvents(sample); !status) return status;
      }
    }
    requests_.BeginStep();
    if (inbox.Has(topics::kTrafficRequests)) {
      for (const lockstep::Sample& sample : inbox.All(topics::kTrafficRequests)) {
        if (auto status = requests_.Take(sample, model_); !status) return status;
      }
    }
    orders_.Before(model_);
    model_.Step(step.dt_s, others_);
    orders_.After(model_);
    TellWhoWaits();
    constexpr std::int64_t kDetailsEvery_ns = 100'000'000;
    const std::int64_t period_ns = std::llround(step.dt_s * 1e9), end_ns = step.time_ns + period_ns;
    Publish(outbox, end_ns / kDetailsEvery_ns > step.time_ns / kDetailsEvery_ns);
    return {};
  }
  void Save(base::StateWriter& out) const override {
    out.Put("model", model_);
    orders_.Save(out);
  }
  void Restore(base::StateReader& in) override {
    in.Get("model", model_);
    orders_.Restore(in, model_);
  }

 private:
  // The opposite of what the car took from its agents.
  base::Status TakeHits(const lockstep::Sample& sample) {
    constexpr std::uint32_t kAgent = 1;  // collisions.idl
    const auto touched = idl::Decode<msg::Collisions>(*sample.payload);
    if (!touched) return touched.error();
    for (const msg::Contact& hit : touched.value().contacts()) {
      if (hit.partner_kind() != kAgent || hit.partner_source() != stream_) continue;
      if (hit.partner_id() >= model_.vehicles()) {
        model_.HitPedestrian(hit.partner_id());
        continue;
      }
      model_.Strike(hit.partner_id(), {-hit.impulse_x_newton_s(), -hit.impulse_y_newton_s()},
                    {hit.position_x_m(), hit.position_y_m()});
    }
    return {};
  }
  base::Status ApplyScenarioEvents(const lockstep::Sample& sample) {
    const auto events = idl::Decode<msg::ScenarioEvents>(*sample.payload);
    if (!events) return events.error();
    for (const msg::ScenarioEvent& event : events.value().events()) {
      if (!event.name().starts_with("traffic.")) continue;
      const std::string where = fmt::format("event '{}' at step {}", event.name(), sample.valid());
      if (auto status = CheckAgainst(model_, {event.name(), event.argument(), event.value()}); !status)
        return status.error().WithContext(where);
      if (event.name() == scenario::kTrafficPedestrian) {
        if (auto status = Call(event.argument(), where); !status) return status;
        continue;
      }
      if (event.name() == scenario::kTrafficAppear) {
        if (auto status = Spawn(event.argument(), event.value(), where); !status) return status;
        continue;
      }
      if (auto status = Tell(event.argument(), *OrderOf(event.name()), event.value(), where); !status) return status;
    }
    return {};
  }
  // That there is no room for it, or that it is there, is no mistake of the scenario's, but a person should know.
  base::Status Spawn(const std::string& argument, double speed_mps, const std::string& where) {
    const auto choice = scenario::ParseAgentOnLane(argument);
    if (!choice) return choice.error().WithContext(where);
    const auto told = model_.Spawn(choice.value().id, choice.value().at->road, choice.value().at->s_m, speed_mps);
    if (!told) return told.error().WithContext(where);
    if (told.value())
      told_to_appear_.emplace_back(choice.value().id, where);
    else
      base::Log(base::LogLevel::kWarning, name_,
                fmt::format("{}: agent {} is on the road already, or waits to be; nothing happens", where,
                            choice.value().id));
    return {};
  }
  void TellWhoWaits() {
    for (const auto& [id, where] : told_to_appear_) {
      if (model_.IsSpawning(id))
        base::Log(base::LogLevel::kWarning, name_,
                  fmt::format("{}: there is no room for agent {} yet; it appears as soon as there is", where, id));
    }
    told_to_appear_.clear();
  }
  base::Status Call(const std::string& argument, const std::string& where) {
    const auto crossing = scenario::ParseCrossing(argument);
    if (!crossing) return crossing.error().WithContext(where);
    const auto status = model_.SpawnPedestrian(crossing.value().road, crossing.value().s_m, crossing.value().from_left);
    return status ? status : status.error().WithContext(where);
  }
  // The agents that an event addresses, at once or when they reach a place.
  base::Status Tell(const std::string& argument, traffic::OrderKind kind, double value, const std::string& where) {
    const auto choice = scenario::ParseAgent(argument);
    if (!choice) return choice.error().WithContext(where);
    const std::vector<std::uint32_t> agents = Meant(choice.value(), where);
    if (!choice.value().at) {
      for (const std::uint32_t id : agents) traffic::ApplyOrder(model_, id, kind, value);
      return {};
    }
    auto order = traffic::PlaceOrders::At(model_, choice.value().at->road, choice.value().at->s_m);
    if (!order) return order.error().WithContext(where);
    order.value().kind = kind, order.value().value = value;
    using Recipients = traffic::PlaceOrder::Recipients;
    using Kind = scenario::AgentChoice::Kind;
    order.value().recipients = choice.value().kind == Kind::kAll    ? Recipients::kAll
                               : choice.value().kind == Kind::kNext ? Recipients::kNext
                                                                    : Recipients::kOne;
    if (order.value().recipients == Recipients::kOne && agents.empty()) return {};  // no vehicle was ahead
    if (order.value().recipients == Recipients::kOne) order.value().id = agents.front();
    orders_.Add(order.value());
    return {};
  }
  // No vehicle ahead is no mistake of the scenario's, but a person should know.
  std::vector<std::uint32_t> Meant(const scenario::AgentChoice& choice, const std::string& where) const {
    std::vector<std::uint32_t> agents;
    switch (choice.kind) {
      case scenario::AgentChoice::Kind::kOne:
        agents.push_back(choice.id);
        break;
      case scenario::AgentChoice::Kind::kAll:
        for (std::uint32_t id = 0; id < model_.vehicles(); ++id) agents.push_back(id);
        break;
      case scenario::AgentChoice::Kind::kAhead:
        if (const auto ahead = others_.empty() ? std::nullopt : model_.LeaderOf(others_.front()))
          agents.push_back(*ahead);
        else
          base::Log(base::LogLevel::kWarning, name_,
                    fmt::format("{}: no vehicle is ahead of the driver's car; nothing happens", where));
        break;
      case scenario::AgentChoice::Kind::kNext:
        break;
    }
    return agents;
  }
  void Publish(lockstep::Outbox& outbox, bool with_details) {
    msg::TrafficState state;
    state.agents().reserve(model_.poses().size());
    for (const traffic::AgentPose& pose : model_.poses())
      state.agents().push_back(ToMessage(pose, model_.traits(pose.id), model_.LightsOf(pose)));
    if (model_.people() != nullptr) {
      for (const traffic::PersonPose& person : model_.people()->Poses()) state.agents().push_back(ToMessage(person));
    }
    outbox.Put(topics::kTrafficState, idl::Encode(state));
    outbox.Put(topics::kSignalsState, idl::Encode(Lights()));
    msg::TrafficDetails details;
    if (with_details) {
      for (const traffic::AgentDetail& detail : model_.Details()) details.agents().push_back(ToMessage(detail));
    }
    outbox.Put(topics::kTrafficDetails, idl::Encode(details));
    if (publishes_answers_) outbox.Put(topics::kTrafficAnswers, idl::Encode(requests_.answers()));
  }

  msg::SignalsState Lights() const {
    msg::SignalsState state;
    const auto controllers = model_.graph().network().controllers();
    for (std::uint32_t i = 0; i < controllers.size(); ++i) {
      if (!controllers[i].times) continue;
      state.groups().emplace_back();
      state.groups().back().controller(i);
      state.groups().back().colour(static_cast<std::uint32_t>(model_.colours()[i]));
    }
    return state;
  }

  std::string name_;
  lockstep::SourceIndex stream_;
  traffic::TrafficModel model_;
  traffic::PlaceOrders orders_;
  TrafficRequests requests_;
  bool publishes_answers_;
  std::vector<driver::Footprint> others_;
  std::vector<std::pair<std::uint32_t, std::string>> told_to_appear_;  // in this step, by which event
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeTrafficNode(launch::NodeContext& context) {
  const traffic::TrafficSettings settings = traffic::ReadTraffic(context.config(), context.seed());
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  if (context.launch().world().empty())
    return base::WrongInput("launch.no_world", "key 'world' is missing; traffic needs roads",
                            context.launch().path().string());
  auto world = road::World::Load(context.launch().world());
  if (!world) return world.error();
  context.set_world_hash(world.value()->content_hash());
  if (const std::filesystem::path map = context.launch().world(); road::IsTrafficMap(map)) {
    if (auto status = traffic::CheckLightsOfMap(map); !status) return status.error();
    const auto companion = traffic_map::LoadHeightsOf(map);
    if (companion && !companion.value().flows.empty() && settings.demand.flows.empty()) {
      base::Log(base::LogLevel::kWarning, context.spec().name,
                fmt::format("{}.yaml: 'flows_vehph' are for 'rodeira traffic run' and the editor; in a run the "
                            "traffic's own 'flows' count",
                            map.string()));
    }
  }
  const std::vector<driver::Footprint> clear = ClearAtStart(context.launch(), *world.value());
  auto model = traffic::TrafficModel::Make(settings, std::move(world).value(), clear);
  if (!model) return model.error();
  if (auto status = CheckScenarios(context, model.value()); !status) return status.error();
  for (const traffic::TightBend& bend : traffic::TightBendsOf(model.value().graph(), settings)) {
    base::Log(base::LogLevel::kWarning, context.spec().name, traffic::Text(bend, model.value().graph()));
  }
  lockstep::SourceIndex stream = 0;
  bool publishes_answers = false;
  for (const lockstep::SourceIndex output : context.spec().outputs) {
    const std::string& topic = context.roster().source(output).topic;
    if (topic == topics::kTrafficState) stream = output;
    publishes_answers = publishes_answers || topic == topics::kTrafficAnswers;
  }
  return std::unique_ptr<lockstep::Node>(
      std::make_unique<TrafficNode>(context.spec().name, stream, std::move(model).value(), publishes_answers));
}

}  // namespace rodeira::nodes

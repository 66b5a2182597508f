// SPDX-License-Identifier: Apache-2.0
#include "nodes/vehicle/vehicle_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "common/core/base/constants.hpp"
#include "common/core/base/log.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "common/vehicle/dynamics/vehicle_notes.hpp"
#include "common/world/road/start_place.hpp"
#include "common/world/road/world.hpp"
#include "common/world/weather/wet_ground.hpp"
#include "idl/codec.hpp"
#include "idl/topics.hpp"
#include "nodes/messages/controls.hpp"
#include "nodes/messages/joint_forces.hpp"
#include "nodes/messages/vehicle_state.hpp"
#include "nodes/vehicle/collisions.hpp"
#include "nodes/vehicle/gust.hpp"
#include "nodes/vehicle/obstacle_map.hpp"
#include "nodes/vehicle/tyre_pressures.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

class VehicleNode final : public lockstep::Node {
 public:
  // `own`: null where the ground is asked for elsewhere.
  VehicleNode(std::string name, lockstep::SourceIndex state_source, std::unique_ptr<dynamics::VehicleModel> model,
              const dynamics::InitialCondition& initial, std::unique_ptr<ground::Ground> own, ground::Ground& ground,
              std::optional<Collisions> collisions, bool publishes_joint_forces)
      : name_(std::move(name)),
        state_source_(state_source),
        model_(std::move(model)),
        initial_(initial),
        own_ground_(std::move(own)),
        ground_(ground),
        collisions_(std::move(collisions)),
        publishes_joint_forces_(publishes_joint_forces) {}

  base::Status Initialise(lockstep::Outbox& outbox) override {
    if (auto status = model_->Initialise(initial_, ground_); !status) return status;  // INI
    Publish(outbox, {}, {});
    return {};
  }

  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    const auto controls = idl::Decode<msg::Controls>(*inbox.Latest(topics::kControls).payload);
    if (!controls) return controls.error();
    if (auto status = ApplyScenarioEvents(inbox); !status) return status;
    msg::Collisions touched;
    dynamics::Wrench push;
    if (collisions_) {
      auto found = collisions_->Find(model_->state(), inbox, step);
      if (!found) return found.error();
      push = found.value().push;
      touched = std::move(found.value().event);
    }
    if (gust_.blows()) {
      const dynamics::Wrench wind = SideWind(model_->state(), model_->dimensions(), gust_.Step(step.dt_s));
      push.force_W += wind.force_W;
      push.moment_WB_W += wind.moment_WB_W;
    }
    if (collisions_ || push.any()) model_->SetPush(push);
    if (pressures_.changed()) model_->SetTyrePressures(pressures_.Step(step.dt_s));
    if (inbox.Has(topics::kWeatherState)) {
      const auto weather = idl::Decode<msg::WeatherState>(*inbox.Latest(topics::kWeatherState).payload);
      if (!weather) return weather.error();
      ground_.set_wetness(weather.value().wetness());
    }
    model_->Step(FromMessage(controls.value()), ground_, step.dt_s);  // CALCULO
    if (auto problem = model_->problem(); !problem) return problem;
    Publish(outbox, controls.value(), touched);
    return {};
  }

  base::Status InitialiseFrom(const std::vector<lockstep::Sample>& published) override {
    const auto newest = std::find_if(published.rbegin(), published.rend(),
                                     [&](const lockstep::Sample& sample) { return sample.source() == state_source_; });
    if (newest == published.rend())
      return base::WrongInput("run.cannot_restore", "no published state of the car was found");
    const auto state = idl::Decode<msg::VehicleState>(*newest->payload);
    if (!state) return state.error();
    return model_->Initialise(dynamics::FromState(FromMessage(state.value())), ground_);
  }

  void Save(base::StateWriter& out) const override {
    out.Put("model", *model_);
    if (collisions_) out.Put("collisions", *collisions_);
    if (gust_.blows()) out.Put("gust", gust_);
    if (pressures_.changed()) out.Put("pressures", pressures_);
  }
  void Restore(base::StateReader& in) override {
    in.Get("model", *model_);
    if (collisions_) in.Get("collisions", *collisions_);
    gust_ = {};
    pressures_ = {};
    if (in.Has("gust")) in.Get("gust", gust_);
    if (in.Has("pressures")) in.Get("pressures", pressures_);
    model_->SetTyrePressures(pressures_.now());
  }
  bool can_save() const override { return model_->can_save(); }

 private:
  // A gust begins; a tyre loses pressure. Where a scenario places this car, INI there: at rest, in equilibrium. A place
  // where it cannot stand is told; then it stays as it is.
  base::Status ApplyScenarioEvents(const lockstep::Inbox& inbox) {
    if (!inbox.Has(topics::kScenarioEvents)) return {};
    for (const lockstep::Sample& sample : inbox.All(topics::kScenarioEvents)) {
      const auto events = idl::Decode<msg::ScenarioEvents>(*sample.payload);
      if (!events) return events.error();
      for (const msg::ScenarioEvent& event : events.value().events()) {
        const auto placed = [&](const base::Error& error) {
          return error.WithContext(fmt::format("event '{}' at step {}", event.name(), sample.valid()));
        };
        if (event.name() == scenario::kVehiclePlace) {
          const auto place = scenario::ParsePlace(event.argument());
          if (!place) return placed(place.error());
          if (place.value().vehicle == name_) Place(place.value(), event.value());
        } else if (event.name() == scenario::kVehicleGust) {
          const auto gust = scenario::ParseGust(event.argument());
          if (!gust) return placed(gust.error());
          if (gust.value().vehicle == name_) BeginGust(gust.value(), event.value());
        } else if (event.name() == scenario::kVehicleTyrePressure) {
          const auto tyre = scenario::ParseTyre(event.argument());
          if (!tyre) return placed(tyre.error());
          if (tyre.value().vehicle == name_) ChangePressure(tyre.value(), event.value());
        }
      }
    }
    return {};
  }
  void BeginGust(const scenario::GustChoice& gust, double peak_mps) {
    if (!model_->can_be_pushed())
      base::Log(base::LogLevel::kWarning, name_,
                "the vehicle model takes no forces from outside: wind does not move it");
    gust_.Begin(gust, peak_mps);
  }
  void ChangePressure(const scenario::TyreChoice& tyre, double share) {
    if (!model_->has_tyre_pressures())
      base::Log(base::LogLevel::kWarning, name_, "the vehicle model has no tyre pressures: their change does nothing");
    pressures_.Change(tyre, share);
  }
  void Place(const scenario::PlaceChoice& place, double heading_deg) {
    dynamics::InitialCondition there;
    there.x_m = place.x_m, there.y_m = place.y_m;
    if (place.z_m) there.z_hint_m = *place.z_m;
    there.heading_rad = heading_deg * base::kPi / 180.0;
    const base::Status placed = model_->Initialise(there, ground_);
    if (!placed)
      base::Log(base::LogLevel::kWarning, name_, fmt::format("it stays where it is: {}", placed.error().Text()));
  }
  void Publish(lockstep::Outbox& outbox, const msg::Controls& controls, const msg::Collisions& touched) const {
    msg::VehicleState state = ToMessage(model_->state(), model_->dimensions());
    state.lights(LightsOf(controls, state.gear()));
    state.horn(controls.horn() != 0 ? 1 : 0);
    outbox.Put(topics::kVehicleState, idl::Encode(state));
    outbox.Put(topics::kCollisions, idl::Encode(touched));
    if (publishes_joint_forces_) outbox.Put(topics::kJointForces, idl::Encode(ToMessage(model_->FindJointForces())));
  }

  std::string name_;
  lockstep::SourceIndex state_source_;
  std::unique_ptr<dynamics::VehicleModel> model_;
  dynamics::InitialCondition initial_;
  std::unique_ptr<ground::Ground> own_ground_;
  weather::WetGround ground_;             // of the newest weather: no state of its own
  std::optional<Collisions> collisions_;  // nothing: the car touches nothing
  bool publishes_joint_forces_;
  Gust gust_;
  TyrePressures pressures_;
};

// The world that the road server has too: what its files answer in this process are the server's bits. `without`: the
// key that does without them.
base::Result<std::shared_ptr<const road::World>> OwnWorld(const launch::NodeContext& context,
                                                          const launch::WorldSummary& summary, const char* without) {
  const std::filesystem::path& file = context.launch().world();
  auto world = road::World::Load(file);
  if (!world)
    return world.error().WithMessage(
        fmt::format("{} (without the world's files: '{}')", world.error().message, without));
  if (world.value()->content_hash() != summary.content_hash) {
    return base::WrongInput(
        "world.other_hash",
        fmt::format(
            "the world's content hash is {} here and {} where the road server is; give both the same files, or '{}'",
            base::Hex(world.value()->content_hash()), base::Hex(summary.content_hash), without),
        file.string());
  }
  return world;
}

struct Settings {
  std::filesystem::path vehicle;
  dynamics::InitialCondition initial;
  bool own_place = false, own_heading = false;  // otherwise the world's
  bool asks = false;                            // for the ground, at each step
  std::string hits;                             // all, traffic, none
};

Settings Read(const config::Map& config) {
  Settings settings;
  settings.vehicle = config.Path("vehicle");
  const config::Map start = config.OptionalChild("start");
  settings.own_place = start.Has("x_m") || start.Has("y_m");
  settings.own_heading = settings.own_place || start.Has("heading_deg");
  if (settings.own_place) {
    settings.initial.x_m = start.Number("x_m");
    settings.initial.y_m = start.Number("y_m");
  }
  settings.initial.heading_rad = start.Number("heading_deg", {-360.0, 360.0}, 0.0) * base::kPi / 180.0;
  settings.initial.speed_mps = start.Number("speed_mps", {-20.0, 100.0}, 0.0);
  settings.asks = config.Choice("ground", {"local", "remote"}, "local") == "remote";
  settings.hits = config.Choice("collisions", {"all", "traffic", "none"}, "all");
  return settings;
}

std::optional<Collisions> CollisionsOf(const std::string& hits, const dynamics::VehicleModel& model,
                                       const road::World* world, const std::string& node) {
  if (hits == "none") return std::nullopt;
  if (!model.can_be_pushed()) {
    base::Log(
        base::LogLevel::kWarning, node,
        "the vehicle model takes no forces of collisions (an FMU: inputs push_x_N … push_moment_z_Nm); collisions "
        "are recorded, but do not move the car");
  }
  const dynamics::VehicleDimensions& dimensions = model.dimensions();
  ObstacleMap map = hits == "all" && world != nullptr ? ObstacleMap(*world, dynamics::BoxOf(dimensions, {}).reach_m())
                                                      : ObstacleMap();
  return std::make_optional<Collisions>(dimensions, std::move(map));
}

void WarnOfStart(const Settings& settings, const road::World* world, const std::string& node) {
  if (world == nullptr || world->network() == nullptr) return;
  const std::string beside = road::StartBesideRoads(*world->network(), settings.initial.x_m, settings.initial.y_m);
  if (!beside.empty()) base::Log(base::LogLevel::kWarning, node, beside);
}

// Wrong input where the launch file asks a model without joints for their forces.
base::Result<bool> PublishesJointForces(launch::NodeContext& context, const dynamics::VehicleModel& model) {
  const lockstep::Roster& roster = context.launch().roster();
  const auto& outputs = context.spec().outputs;
  if (std::none_of(outputs.begin(), outputs.end(),
                   [&](lockstep::SourceIndex output) { return roster.source(output).topic == topics::kJointForces; }))
    return false;
  if (model.has_joint_forces()) return true;
  return base::WrongInput("vehicle.no_joints",
                          fmt::format("'outputs' of node '{}' names joint_forces, but its vehicle has no joints; a "
                                      "vehicle file with 'model: multibody' was expected",
                                      context.spec().name),
                          context.launch().path().string());
}

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeVehicleNode(launch::NodeContext& context) {
  Settings settings = Read(context.config());
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  auto model = dynamics::LoadVehicle(settings.vehicle, context.launch().vehicle_model());
  if (!model) return model.error();
  for (const std::string& note : dynamics::NotesOn(*model.value(), settings.vehicle))
    base::Log(base::LogLevel::kWarning, context.spec().name, note);
  const auto joint_forces = PublishesJointForces(context, *model.value());
  if (!joint_forces) return joint_forces.error();
  const auto summary = context.World();
  if (!summary) return summary.error();
  if (!settings.own_place) {
    settings.initial.x_m = summary.value().start_x_m;
    settings.initial.y_m = summary.value().start_y_m;
  }
  if (!settings.own_heading) settings.initial.heading_rad = summary.value().start_heading_rad;
  context.set_world_hash(summary.value().content_hash);
  const bool own_ground = !settings.asks && !context.has_local_ground();
  std::shared_ptr<const road::World> world;
  if (own_ground || (settings.hits == "all" && !context.launch().world().empty())) {
    auto made =
        OwnWorld(context, summary.value(), own_ground ? "ground: remote, collisions: traffic" : "collisions: traffic");
    if (!made) return made.error();
    world = std::move(made).value();
  }
  WarnOfStart(settings, world.get(), context.spec().name);
  std::unique_ptr<ground::Ground> own = own_ground ? world->MakeGround() : nullptr;
  ground::Ground& ground = own != nullptr ? *own : context.Ground();
  std::optional<Collisions> collisions = CollisionsOf(settings.hits, *model.value(), world.get(), context.spec().name);
  return std::unique_ptr<lockstep::Node>(std::make_unique<VehicleNode>(
      context.spec().name, context.spec().outputs.front(), std::move(model).value(), settings.initial, std::move(own),
      ground, std::move(collisions), joint_forces.value()));
}

}  // namespace rodeira::nodes

// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/autopilot_source.hpp"

#include <cmath>
#include <map>
#include <utility>

#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/lights_ahead.hpp"
#include "common/driving/driver/way_from_start.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "nodes/messages/vehicle_state.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

// What others take up. A pedestrian who crosses is given the way of the next seconds, so as to be seen
// in time.
driver::Footprint FootprintOf(const msg::TrafficAgent& agent) {
  constexpr std::uint32_t kPedestrian = 4;  // traffic.idl
  constexpr double kAhead_s = 6.0;
  driver::Footprint footprint{agent.id(),
                              agent.position_x_m(),
                              agent.position_y_m(),
                              static_cast<double>(agent.heading_rad()),
                              agent.speed_mps(),
                              static_cast<double>(agent.length_m()),
                              static_cast<double>(agent.width_m())};
  if (agent.kind() != kPedestrian) return footprint;
  const double way = kAhead_s * footprint.speed_mps;
  footprint.x_m += 0.5 * way * std::cos(footprint.heading_rad);
  footprint.y_m += 0.5 * way * std::sin(footprint.heading_rad);
  footprint.length_m += way;
  return footprint;
}

class AutopilotSource final : public Source {
 public:
  // The way belongs to the world, which is kept alive.
  AutopilotSource(std::shared_ptr<const road::World> world, const driver::AutopilotSettings& settings,
                  const dynamics::VehicleDimensions& dimensions, driver::WayAndLights way)
      : world_(std::move(world)),
        dimensions_(dimensions),
        lines_(std::move(way.lines)),
        autopilot_(settings, std::move(way.way)) {}

  dynamics::Controls First() override { return {}; }

  base::Result<dynamics::Controls> Step(const lockstep::StepInfo& step, std::int64_t,
                                        const lockstep::Inbox& inbox) override {
    const auto own = idl::Decode<msg::VehicleState>(*inbox.Latest(topics::kVehicleState).payload);
    if (!own) return own.error();
    others_.clear();
    for (const lockstep::Sample& sample : inbox.All(topics::kTrafficState)) {
      const auto traffic = idl::Decode<msg::TrafficState>(*sample.payload);
      if (!traffic) return traffic.error();
      for (const msg::TrafficAgent& agent : traffic.value().agents()) others_.push_back(FootprintOf(agent));
    }
    if (auto status = SeeLights(inbox); !status) return status.error();
    const dynamics::VehicleState state = FromMessage(own.value());
    return autopilot_.Step({state, dimensions_, others_, lights_}, step.dt_s);
  }

  void Save(base::StateWriter& out) const override { out.Put("autopilot", autopilot_); }
  void Restore(base::StateReader& in) override { in.Get("autopilot", autopilot_); }
  void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& /*signals*/) override {
    autopilot_.InitialiseFrom(last);
  }

 private:
  // Lights without a sample are dark.
  base::Status SeeLights(const lockstep::Inbox& inbox) {
    lights_.clear();
    std::map<std::uint32_t, network::LightColour> colours;
    for (const lockstep::Sample& sample : inbox.All(topics::kSignalsState)) {
      const auto signals = idl::Decode<msg::SignalsState>(*sample.payload);
      if (!signals) return signals.error();
      for (const msg::SignalGroup& group : signals.value().groups())
        colours[group.controller()] = static_cast<network::LightColour>(group.colour());
    }
    for (const driver::LightLine& line : lines_) {
      const auto colour = colours.find(line.controller);
      if (colour != colours.end()) lights_.push_back({line.d_m, colour->second});
    }
    return {};
  }

  std::shared_ptr<const road::World> world_;
  dynamics::VehicleDimensions dimensions_;
  std::vector<driver::LightLine> lines_;
  driver::Autopilot autopilot_;
  std::vector<driver::Footprint> others_;
  std::vector<driver::LightAhead> lights_;
};

}  // namespace

base::Result<std::unique_ptr<Source>> MakeAutopilotSource(const config::Map& config, launch::NodeContext& context) {
  const std::filesystem::path driver_file = config.Path("driver");
  const std::filesystem::path vehicle_file = config.Path("vehicle");
  const bool has_lane = config.Has("lane");
  const auto wanted_lane = static_cast<int>(config.Integer("lane", -20, 20, 0));
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  bool sees_the_car = false;
  for (const lockstep::Port& port : context.spec().inputs)
    sees_the_car = sees_the_car || port.topic == topics::kVehicleState;
  if (!sees_the_car)
    return base::WrongInput("launch.not_wired",
                            "the autopilot needs the state of the car that it drives; wire 'vehicle_state' to it",
                            config.Place());
  const auto settings = driver::LoadDriver(driver_file);
  if (!settings) return settings.error();
  const auto model = dynamics::LoadVehicle(vehicle_file, context.launch().vehicle_model());
  if (!model) return model.error();
  auto world = road::World::Load(context.launch().world());
  if (!world) return world.error();
  auto way = has_lane ? driver::WayFromStart(*world.value(), wanted_lane, config.Place("lane"))
                      : driver::WayFromStart(*world.value(), std::nullopt, context.launch().world().string());
  if (!way) return way.error();
  context.set_world_hash(world.value()->content_hash());
  return std::unique_ptr<Source>(std::make_unique<AutopilotSource>(
      std::move(world).value(), settings.value(), model.value()->dimensions(), std::move(way).value()));
}

}  // namespace rodeira::nodes

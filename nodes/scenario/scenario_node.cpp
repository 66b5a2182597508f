// SPDX-License-Identifier: Apache-2.0
#include "nodes/scenario/scenario_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/core/base/suggest.hpp"
#include "common/driving/scenario/request.hpp"
#include "common/driving/scenario/scenario_file.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_weather.hpp"
#include "common/world/weather/named_weather.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

// A road with stations: a chain of the network's roads.
class Stations {
 public:
  Stations(const network::Network& network, road::RoadChain chain)
      : length_m_(chain.length_m), network_(&network), chain_(std::move(chain)) {
    id_ = road::IdOf(network, chain_);  // what remains of a road between junctions is ID/1, ID/2 …
  }

  const std::string& id() const { return id_; }
  double length_m() const { return length_m_; }
  // Where the part ID/1, ID/2 … begins, and its length; nothing: the road has no such part.
  std::optional<std::pair<double, double>> PartOf(std::string_view id) const {
    for (const road::RoadChain::Part& part : chain_.parts) {
      const network::Road& road = network_->roads()[part.road];
      if (road.id() == id) return std::pair(part.from_s_m, road.length_m());
    }
    return std::nullopt;
  }

  // Where the car is along the road: kNowhere where it is not on this one. In a junction, on a way that is another
  // road's, nothing new is known: `before_m` again.
  double At(const Eigen::Vector3d& p_W, double before_m) const {
    const auto place = network_->Locate(p_W.x(), p_W.y(), p_W.z());
    if (!place) return kNowhere;
    for (const road::RoadChain::Part& part : chain_.parts) {
      if (part.road == place->lane.road) return part.from_s_m + place->s_m;
    }
    return network_->roads()[place->lane.road].spec().junction.empty() ? kNowhere : before_m;
  }

 private:
  std::string id_;
  double length_m_;
  const network::Network* network_;
  road::RoadChain chain_;
};

std::vector<Stations> StationsOf(const road::World& world) {
  std::vector<Stations> all;
  if (world.network() != nullptr) {
    for (road::RoadChain& chain : road::ChainsOf(*world.network()))
      all.emplace_back(*world.network(), std::move(chain));
  }
  return all;
}

// A station that the car may pass, and whether it has.
class Gate {
 public:
  Gate(Stations road, double passes_m) : road_(std::move(road)), passes_m_(passes_m) {}

  // Whether the car, now at p_W, has passed since it was last seen; true once only.
  bool Passed(const Eigen::Vector3d& p_W) {
    const double before_m = seen_m_;
    seen_m_ = road_.At(p_W, before_m);
    if (done_ || std::isnan(before_m) || std::isnan(seen_m_)) return false;
    done_ = (before_m < passes_m_) != (seen_m_ < passes_m_);
    return done_;
  }

  void Save(base::StateWriter& out) const {
    out.Put("seen_m", seen_m_);
    out.Put("done", done_);
  }
  void Restore(base::StateReader& in) {
    in.Get("seen_m", seen_m_);
    in.Get("done", done_);
  }

 private:
  Stations road_;
  double passes_m_;
  double seen_m_ = kNowhere;
  bool done_ = false;
};

// The car that an event names is one that receives the events of this node.
base::Status CheckVehicle(const scenario::Event& event, const std::vector<std::string>& vehicles) {
  std::string vehicle;
  const auto read = [&](const auto& parsed) -> base::Status {
    if (!parsed) return parsed.error();
    vehicle = parsed.value().vehicle;
    return {};
  };
  const base::Status known = event.name == scenario::kVehicleGust ? read(scenario::ParseGust(event.argument))
                             : event.name == scenario::kVehicleTyrePressure
                                 ? read(scenario::ParseTyre(event.argument))
                                 : read(scenario::ParsePlace(event.argument));
  if (!known) return known;
  if (std::find(vehicles.begin(), vehicles.end(), vehicle) != vehicles.end()) return {};
  return base::WrongInput("launch.not_wired", fmt::format("no vehicle '{}' is wired to this scenario{}", vehicle,
                                                          base::DidYouMean(vehicle, vehicles)));
}

class ScenarioNode final : public lockstep::Node {
 public:
  // `requests`: what windows ask for; null: none may.
  ScenarioNode(std::string name, scenario::Scenario scenario, std::int64_t base_step_ns,
               std::shared_ptr<const road::World> world, std::vector<Gate> gates,
               std::unique_ptr<launch::LiveRequestsReceiver> requests, std::vector<std::string> vehicles)
      : name_(std::move(name)),
        scenario_(std::move(scenario)),
        base_step_ns_(base_step_ns),
        world_(std::move(world)),
        gates_(std::move(gates)),
        requests_(std::move(requests)),
        vehicles_(std::move(vehicles)),
        weather_(scenario_.weather) {}

  // The initial sample may stand at several steps (law L1), so no event is said in it; the weather is that of the run's
  // beginning.
  base::Status Initialise(lockstep::Outbox& outbox) override {
    outbox.Put(topics::kScenarioEvents, idl::Encode(msg::ScenarioEvents()));
    outbox.Put(topics::kWeatherState, idl::Encode(WeatherAt(0)));
    return {};
  }

  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    msg::ScenarioEvents events;
    const auto due =
        std::lower_bound(scenario_.scheduled.begin(), scenario_.scheduled.end(), step.output_valid,
                         [](const scenario::ScheduledEvent& event, lockstep::Step at) { return event.step < at; });
    for (auto event = due; event != scenario_.scheduled.end() && event->step == step.output_valid; ++event)
      Add(event->event, step.output_valid, events);
    if (!gates_.empty()) {
      const auto car = idl::Decode<msg::VehicleState>(*inbox.Latest(topics::kVehicleState).payload);
      if (!car) return car.error();
      for (std::size_t i = 0; i < gates_.size(); ++i) {
        if (gates_[i].Passed(
                {car.value().position_w_m().x(), car.value().position_w_m().y(), car.value().position_w_m().z()}))
          Add(scenario_.conditional[i].event, step.output_valid, events);
      }
    }
    if (requests_ != nullptr) TakeRequests(step.output_valid, events);
    outbox.Put(topics::kScenarioEvents, idl::Encode(events));
    outbox.Put(topics::kWeatherState, idl::Encode(WeatherAt(step.output_valid)));
    return {};
  }

  bool runs_inline() const override { return true; }
  void Save(base::StateWriter& out) const override {
    for (const Gate& gate : gates_) out.Put("gate", gate);
    out.Put("weathers", static_cast<std::uint32_t>(became_.size()));
    for (const Became& became : became_) {
      out.Put("name", became.name);
      out.Put("step", became.step);
      out.Put("over_s", became.over_s);
    }
  }
  void Restore(base::StateReader& in) override {
    for (Gate& gate : gates_) in.Get("gate", gate);
    weather_ = scenario_.weather;
    became_.clear();
    std::uint32_t count = 0;
    in.Get("weathers", count);
    for (std::uint32_t i = 0; i < count; ++i) {
      Became became;
      in.Get("name", became.name);
      in.Get("step", became.step);
      in.Get("over_s", became.over_s);
      if (became.name.empty()) break;  // it cannot be read
      Become(became);
    }
  }

 private:
  // A weather that an event has brought, from its step on.
  struct Became {
    std::string name;
    lockstep::Step step = 0;
    double over_s = 0.0;
  };

  double Seconds(lockstep::Step step) const { return static_cast<double>(step * base_step_ns_) * 1e-9; }

  msg::WeatherState WeatherAt(lockstep::Step step) const {
    const weather::Weather now = weather_.At(Seconds(step));
    msg::WeatherState out;
    out.wetness(now.wetness);
    out.rain_mmph(now.rain_mmph);
    out.visibility_m(now.visibility_m);
    out.clouds(now.clouds);
    out.hour(now.hour);
    return out;
  }

  void Become(const Became& became) {
    const auto named = weather::FindWeather(became.name);
    if (!named) return;  // a state of other words than ours
    weather::Change change = named.value();
    change.at_s = Seconds(became.step);
    change.over_s = became.over_s;
    weather_.Add(change);
    became_.push_back(became);
  }

  // What cannot be obeyed is told, and is no event.
  void TakeRequests(lockstep::Step valid, msg::ScenarioEvents& events) {
    for (const launch::LiveRequest& request : requests_->Take()) {
      const auto event = scenario::EventOf({request.name, request.argument, request.x_m, request.y_m, request.value});
      base::Status sound = event ? base::Status() : event.error();
      if (sound && event.value().name.starts_with("vehicle.")) sound = CheckVehicle(event.value(), vehicles_);
      if (sound)
        Add(event.value(), valid, events);
      else
        base::Log(base::LogLevel::kWarning, name_, fmt::format("a request is refused: {}", sound.error().Text()));
    }
  }

  void Add(const scenario::Event& event, lockstep::Step valid, msg::ScenarioEvents& events) {
    if (event.name == scenario::kWeatherChange) Become({event.argument, valid, event.value});
    msg::ScenarioEvent out;
    out.name(event.name);
    out.argument(event.argument);
    out.value(event.value);
    out.index(static_cast<std::uint32_t>(events.events().size()));
    events.events().push_back(std::move(out));
  }

  std::string name_;
  scenario::Scenario scenario_;
  std::int64_t base_step_ns_;
  std::shared_ptr<const road::World> world_;
  std::vector<Gate> gates_;  // one for each conditional event
  std::unique_ptr<launch::LiveRequestsReceiver> requests_;
  std::vector<std::string> vehicles_;  // that obey it
  weather::WeatherPlan weather_;       // the file's and what became of it
  std::vector<Became> became_;
};

// The nodes of this kind that obey the node's events.
std::vector<std::string> Obedient(const launch::NodeContext& context, std::string_view kind) {
  std::vector<std::string> names;
  for (const lockstep::RosterNode& node : context.roster().nodes()) {
    if (node.kind != kind) continue;
    for (const lockstep::Port& port : node.inputs) {
      if (port.topic != topics::kScenarioEvents) continue;
      for (const lockstep::SourceIndex source : port.sources) {
        if (context.roster().source(source).node == context.index()) names.push_back(node.name);
      }
    }
  }
  return names;
}

base::Status CheckObeyed(const launch::NodeContext& context, const scenario::Scenario& scenario,
                         const std::filesystem::path& file) {
  const bool traffic = !Obedient(context, "traffic").empty();
  const std::vector<std::string> vehicles = Obedient(context, "vehicle");
  const auto check = [&](const scenario::Event& event) -> base::Status {
    if (event.name.starts_with("vehicle.")) {
      const base::Status known = CheckVehicle(event, vehicles);
      return known ? known : known.error().WithContext(file.string());
    }
    if (traffic || !event.name.starts_with("traffic.")) return {};
    return base::WrongInput(
        "launch.not_wired",
        fmt::format("'{}' speaks to the traffic, but no node of kind 'traffic' is wired to this scenario", event.name),
        file.string());
  };
  for (const auto& event : scenario.scheduled) {
    if (auto status = check(event.event); !status) return status;
  }
  for (const auto& event : scenario.conditional) {
    if (auto status = check(event.event); !status) return status;
  }
  return {};
}

base::Result<std::vector<Gate>> MakeGates(const launch::NodeContext& context, const scenario::Scenario& scenario,
                                          const road::World& world) {
  const bool sees = std::any_of(context.spec().inputs.begin(), context.spec().inputs.end(),
                                [](const lockstep::Port& port) { return port.topic == topics::kVehicleState; });
  std::vector<std::string> names;
  const std::vector<Stations> roads = StationsOf(world);
  for (const Stations& road : roads) names.push_back(road.id());
  std::vector<Gate> gates;
  for (const scenario::ConditionalEvent& event : scenario.conditional) {
    if (!sees)
      return base::WrongInput("launch.not_wired",
                              "'passes_m' waits for the driver's car; wire 'vehicle_state' to the scenario",
                              event.place);
    double begin_m = 0.0;
    std::optional<double> length_m;  // of the part that is named
    auto road = std::find(names.begin(), names.end(), event.road);
    if (event.road.empty() && names.size() == 1) road = names.begin();
    for (std::size_t i = 0; road == names.end() && i < roads.size(); ++i) {
      const auto part = roads[i].PartOf(event.road);
      if (!part) continue;
      road = names.begin() + static_cast<std::ptrdiff_t>(i);
      begin_m = part->first, length_m = part->second;
    }
    if (event.road.empty() && names.size() > 1) {
      return base::WrongInput(
          "scenario.no_road_named",
          fmt::format("'passes_m' is on no road that is named, and the world has {}; 'road' was expected beside it",
                      names.size()),
          event.place);
    }
    if (road == names.end())
      return base::WrongInput("world.unknown_road",
                              fmt::format("there is no road '{}'{}", event.road,
                                          base::DidYouMean(event.road, road::NamesOfRoads(*world.network()))),
                              event.place);
    const Stations& found = roads[static_cast<std::size_t>(road - names.begin())];
    if (event.passes_m > length_m.value_or(found.length_m())) {
      return base::WrongInput("scenario.off_the_road",
                              fmt::format("'passes_m' is {}; road '{}' is {:.1f} m long", event.passes_m,
                                          length_m ? event.road : found.id(), length_m.value_or(found.length_m())),
                              event.place);
    }
    gates.emplace_back(found, begin_m + event.passes_m);
  }
  return gates;
}

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeScenarioNode(launch::NodeContext& context) {
  const bool takes_requests = context.config().Flag("requests", false);
  const std::filesystem::path file =
      takes_requests ? context.config().OptionalPath("scenario").value_or("") : context.config().Path("scenario");
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  const scenario::Timing timing{context.roster().base_step_ns(), context.spec().period, context.spec().delay};
  auto scenario = file.empty() ? scenario::Scenario() : scenario::LoadScenario(file, timing);
  if (!scenario) return scenario.error();
  if (auto status = CheckObeyed(context, scenario.value(), file); !status) return status.error();
  if (!context.launch().world().empty()) {
    const auto own = road::WeatherOf(context.launch().world());
    if (!own) return own.error();
    if (own.value()) scenario.value().weather.Begin(*own.value());  // what the scenario names stands above it
  }
  std::shared_ptr<const road::World> world;
  std::vector<Gate> gates;
  if (!scenario.value().conditional.empty()) {
    if (context.launch().world().empty())
      return base::WrongInput("launch.no_world", "key 'world' is missing; 'passes_m' needs roads",
                              context.launch().path().string());
    auto loaded = road::World::Load(context.launch().world());
    if (!loaded) return loaded.error();
    world = std::move(loaded).value();
    context.set_world_hash(world->content_hash());
    auto made = MakeGates(context, scenario.value(), *world);
    if (!made) return made.error();
    gates = std::move(made).value();
  }
  return std::unique_ptr<lockstep::Node>(std::make_unique<ScenarioNode>(
      context.spec().name, std::move(scenario).value(), context.roster().base_step_ns(), std::move(world),
      std::move(gates), takes_requests ? context.RequestsReceiver() : nullptr, Obedient(context, "vehicle")));
}

}  // namespace rodeira::nodes

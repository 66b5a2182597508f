// SPDX-License-Identifier: Apache-2.0
#include "nodes/traffic/event_check.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>

#include "common/driving/scenario/scenario_file.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

namespace topics = idl::topics;

base::Status CheckAgent(const traffic::TrafficModel& model, const scenario::AgentChoice& choice) {
  if (choice.kind == scenario::AgentChoice::Kind::kOne && choice.id >= model.vehicles()) {
    return base::WrongInput("traffic.unknown_agent",
                            fmt::format("there is no agent {}; there are {}, from 0 on", choice.id, model.vehicles()));
  }
  if (!choice.at) return {};
  const auto order = traffic::PlaceOrders::At(model, choice.at->road, choice.at->s_m);
  return order ? base::Status() : order.error();
}

base::Status CheckOf(const traffic::TrafficModel& model, const scenario::Event& event, const std::string& place) {
  if (!event.name.starts_with("traffic.")) return {};
  const auto status = CheckAgainst(model, event);
  return status ? status
                : status.error()
                      .WithMessage(fmt::format("'{}': {}", event.name, status.error().message))
                      .WithContext(place);
}

}  // namespace

std::optional<traffic::OrderKind> OrderOf(std::string_view event) {
  using traffic::OrderKind;
  if (event == scenario::kTrafficBrake) return OrderKind::kBrake;
  if (event == scenario::kTrafficSpeed) return OrderKind::kSpeed;
  if (event == scenario::kTrafficRelease) return OrderKind::kRelease;
  if (event == scenario::kTrafficOvertake) return OrderKind::kOvertake;
  if (event == scenario::kTrafficChangeLane) return OrderKind::kChangeLane;
  return std::nullopt;
}

base::Status CheckAgainst(const traffic::TrafficModel& model, const scenario::Event& event) {
  if (event.name == scenario::kTrafficPedestrian) {
    const auto crossing = scenario::ParseCrossing(event.argument);
    return crossing ? model.CheckSpawnPedestrian(crossing.value().road, crossing.value().s_m) : crossing.error();
  }
  if (event.name == scenario::kTrafficAppear) {
    const auto choice = scenario::ParseAgentOnLane(event.argument);
    if (!choice) return choice.error();
    if (!(event.value >= 0.0))
      return base::WrongInput("scenario.wrong_value",
                              fmt::format("its speed is {}; at least 0 was expected", event.value));
    return model.CheckSpawn(choice.value().id, choice.value().at->road, choice.value().at->s_m);
  }
  const auto kind = OrderOf(event.name);
  if (!kind) return base::WrongInput("scenario.unknown_event", "the traffic does not know this event");
  if (!traffic::IsSound(*kind, event.value))
    return base::WrongInput("scenario.wrong_value",
                            fmt::format("its value is {}; one that the traffic can obey was expected", event.value));
  const auto choice = scenario::ParseAgent(event.argument);
  return choice ? CheckAgent(model, choice.value()) : choice.error();
}

base::Status CheckScenarios(const launch::NodeContext& context, const traffic::TrafficModel& model) {
  const launch::Launch& launch = context.launch();
  for (const lockstep::Port& port : context.spec().inputs) {
    if (port.topic != topics::kScenarioEvents) continue;
    for (const lockstep::SourceIndex source : port.sources) {
      const lockstep::NodeIndex node = context.roster().source(source).node;
      const auto named = launch.node(node).config->Peek({"config", "scenario"});
      if (!named) continue;
      const std::filesystem::path file = (launch.path().parent_path() / *named).lexically_normal();
      std::error_code problem;
      if (!std::filesystem::is_regular_file(file, problem)) continue;
      const lockstep::RosterNode& says = context.roster().node(node);
      const auto scenario = scenario::LoadScenario(file, {context.roster().base_step_ns(), says.period, says.delay});
      if (!scenario) continue;  // that node says it
      for (const auto& event : scenario.value().scheduled) {
        if (auto status = CheckOf(model, event.event, event.place); !status) return status;
      }
      for (const auto& event : scenario.value().conditional) {
        if (auto status = CheckOf(model, event.event, event.place); !status) return status;
      }
    }
  }
  return {};
}

}  // namespace rodeira::nodes

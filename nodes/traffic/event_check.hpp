// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/driving/scenario/event.hpp"
#include "common/runtime/launch/node_context.hpp"
#include "common/traffic/place_orders.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::nodes {

// What a traffic event tells its vehicles; nothing for an event about vehicles that do not drive yet.
std::optional<traffic::OrderKind> OrderOf(std::string_view event);

// Wrong input where the traffic can never do what an event asks: no such agent, road, lane, station or crossing, or a
// value that no vehicle can obey.
base::Status CheckAgainst(const traffic::TrafficModel& model, const scenario::Event& event);

// The same of all events of the scenarios that this node listens to, before the run begins, each with its line: an
// experiment does not end in its twentieth minute for a slip of the pen. Files that are not on this machine are left to
// what reads them.
base::Status CheckScenarios(const launch::NodeContext& context, const traffic::TrafficModel& model);

}  // namespace rodeira::nodes

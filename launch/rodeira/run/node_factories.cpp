// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/node_factories.hpp"

#include "launch/rodeira/graphics/graphics.hpp"
#include "nodes/empty/empty_node.hpp"
#include "nodes/input/input_node.hpp"
#include "nodes/measures/measures_node.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/scenario/scenario_node.hpp"
#include "nodes/traffic/traffic_node.hpp"
#include "nodes/vehicle/vehicle_node.hpp"

namespace rodeira::cli {

launch::NodeFactory FactoryOf(std::string_view kind) {
  if (kind == "empty") return nodes::MakeEmptyNode;
  if (kind == "input") return nodes::MakeInputNode;
  if (kind == "measures") return nodes::MakeMeasuresNode;
  if (kind == "recorder") return nodes::MakeRecorderNode;
  if (kind == "scenario") return nodes::MakeScenarioNode;
  if (kind == "traffic") return nodes::MakeTrafficNode;
  if (kind == "vehicle") return nodes::MakeVehicleNode;
  if (const Graphics* graphics = RegisteredGraphics(); kind == "view" && graphics != nullptr) return graphics->view;
  return nullptr;
}

}  // namespace rodeira::cli

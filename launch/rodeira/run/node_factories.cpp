// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/node_factories.hpp"

#include <fmt/format.h>

#include "common/runtime/launch/node_library.hpp"
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

base::Result<launch::NodeFactory> FactoryOf(const launch::LaunchNode& node) {
  const std::string& kind = node.kind->name;
  if (node.is_external() && !node.kind->library.empty()) return launch::LoadNodeLibrary(node.kind->library);
  if (node.is_external())
    return base::WrongInput(
        "launch.not_in_process",
        fmt::format("its program {} is a process of its own; a run in one process needs its shared object, as "
                    "'library'",
                    node.kind->program));
  if (launch::NodeFactory factory = FactoryOf(kind)) return factory;
  if (kind == "view")
    return base::WrongInput("launch.not_built_in", "this program has no view: it was built with RODEIRA_VIEW=OFF");
  return base::WrongInput("launch.not_in_process", fmt::format("nodes of kind '{}' do not run in one process", kind));
}

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/shared_nodes.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "common/runtime/dds/run.hpp"
#include "common/world/road/kept_world.hpp"
#include "launch/rodeira/run/node_factories.hpp"
#include "nodes/road/road_service.hpp"

namespace rodeira::cli {
namespace {

base::Result<dds::SharedProcess::Factory> FactoryIn(const launch::LaunchNode& node) {
  if (node.kind->name == "road") return dds::SharedProcess::Factory{nullptr, nodes::MakeRoadService};
  auto factory = FactoryOf(node);
  if (!factory) return factory.error();
  return dds::SharedProcess::Factory{std::move(factory).value(), nullptr};
}

bool LoadsWorld(const launch::LaunchNode& node) {
  const std::string& kind = node.kind->name;
  if (kind == "input") return node.config->Peek({"config", "source"}) == "autopilot";
  return kind != "recorder" && kind != "empty" && !node.is_external();
}

// A world that cannot be loaded is refused by each node that loads it.
std::shared_ptr<const void> KeepWorld(const launch::Launch& launch, const std::vector<lockstep::NodeIndex>& nodes) {
  const auto users = std::ranges::count_if(nodes, [&](lockstep::NodeIndex n) { return LoadsWorld(launch.node(n)); });
  if (users < 2 || launch.world().empty()) return nullptr;
  auto world = road::World::Load(launch.world());
  if (!world) return nullptr;
  return std::make_shared<const road::KeptWorld>(launch.world(), std::move(world).value());
}

}  // namespace

int RunSharedNodes(std::string_view program, int argc, char** argv) {
  return dds::RunSharedProcess(program, argc, argv, {FactoryIn, KeepWorld});
}

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/local_nodes.hpp"

#include <fmt/format.h>

#include "common/runtime/launch/node_library.hpp"
#include "launch/rodeira/run/node_factories.hpp"
#include "nodes/road/road_service.hpp"

namespace rodeira::cli {
namespace {

class LocalContext final : public launch::NodeContext {
 public:
  LocalContext(const launch::Launch& launch, lockstep::NodeIndex index, std::shared_ptr<const road::World> world,
               launch::LiveKeysBoard& keys, launch::LiveRequestsBoard& requests, launch::RunLogBoard* log)
      : NodeContext(launch, index), world_(std::move(world)), keys_(keys), requests_(requests), log_(log) {
    if (world_ != nullptr) ground_ = world_->MakeGround();
  }
  ground::Ground& Ground() override {
    RODEIRA_ASSERT(ground_ != nullptr);  // World() comes first and refuses
    return *ground_;
  }
  bool has_local_ground() const override { return true; }
  base::Result<launch::WorldSummary> World() override {
    if (world_ == nullptr)
      return base::WrongInput("launch.no_road_server", "the launch file has no node of kind 'road'",
                              launch().path().string());
    return nodes::Summary(*world_);
  }
  std::unique_ptr<launch::LiveKeysSender> KeysSender() override { return keys_.MakeSender(); }
  std::unique_ptr<launch::LiveKeysReceiver> KeysReceiver() override { return keys_.MakeReceiver(); }
  std::unique_ptr<launch::LiveRequestsSender> RequestsSender() override { return requests_.MakeSender(); }
  std::unique_ptr<launch::LiveRequestsReceiver> RequestsReceiver() override { return requests_.MakeReceiver(); }
  std::unique_ptr<launch::RunLogReceiver> RunLog() override { return log_ == nullptr ? nullptr : log_->MakeReceiver(); }

 private:
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<ground::Ground> ground_;
  launch::LiveKeysBoard& keys_;
  launch::LiveRequestsBoard& requests_;
  launch::RunLogBoard* log_;
};

// The world of the run, where a road server would load it.
base::Result<std::shared_ptr<const road::World>> LoadWorld(const launch::Launch& launch) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "road") continue;
    if (launch.world().empty())
      return base::WrongInput("launch.no_world", "key 'world' is missing; a road server needs a world file",
                              launch.path().string());
    return road::World::Load(launch.world());
  }
  return std::shared_ptr<const road::World>();
}

}  // namespace

LocalNodes::LocalNodes(LocalNodes&&) noexcept = default;
LocalNodes::~LocalNodes() = default;

base::Result<LocalNodes> LocalNodes::Make(const launch::Launch& launch, const StandIn& stand_in,
                                          launch::RunLogBoard* log) {
  const auto& roster = launch.roster();
  auto world = LoadWorld(launch);
  if (!world) return world.error();
  LocalNodes made;
  if (world.value() != nullptr) {
    made.world_hash_ = world.value()->content_hash();
    made.world_warnings_.assign(world.value()->warnings().begin(), world.value()->warnings().end());
  }
  for (lockstep::NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    made.contexts_.push_back(
        std::make_unique<LocalContext>(launch, n, world.value(), *made.keys_, *made.requests_, log));
    made.nodes_.push_back(nullptr);
    if (roster.node(n).role == lockstep::Role::kService) continue;
    if (auto other = stand_in ? stand_in(n) : nullptr) {
      made.owned_.push_back(std::move(other));
      made.nodes_.back() = made.owned_.back().get();
      continue;
    }
    const auto factory = FactoryOf(launch.node(n));
    if (!factory) return factory.error().In(fmt::format("node '{}'", roster.node(n).name));
    (void)made.contexts_.back()->config();  // so that the keys of a node that reads none are unknown ones
    auto node = factory.value()(*made.contexts_.back());
    if (node.ok()) node = launch::AsManifestSays(*launch.node(n).kind, std::move(node).value());
    if (!node) return node.error().In(fmt::format("node '{}'", roster.node(n).name));
    made.owned_.push_back(std::move(node).value());
    made.nodes_.back() = made.owned_.back().get();
  }
  if (auto status = launch.file().Finish(); !status) return status.error();
  return made;
}

}  // namespace rodeira::cli

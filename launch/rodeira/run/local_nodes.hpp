// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::cli {

// All stepped nodes of a launch file in this process, with SUELO from the library on one common world.
class LocalNodes {
 public:
  // A node that stands for the roster's own (of a recording), or null where the launch file's is made.
  using StandIn = std::function<std::unique_ptr<lockstep::Node>(lockstep::NodeIndex)>;

  // Wrong input where a configuration, the world or another file is wrong; it names the node. The launch must outlive
  // it. `log`: where the clock's log passes, outlives it; null: no node hears of it.
  static base::Result<LocalNodes> Make(const launch::Launch& launch, const StandIn& stand_in = {},
                                       launch::RunLogBoard* log = nullptr);
  LocalNodes(LocalNodes&&) noexcept;
  ~LocalNodes();

  // One for each node of the roster; null for services.
  const std::vector<lockstep::Node*>& nodes() const { return nodes_; }
  // Of the world on which they are; 0 where there is none.
  base::Digest world_hash() const { return world_hash_; }
  // What was repaired in the world's OpenDRIVE file: one sentence a kind. The caller prints them once.
  const std::vector<std::string>& world_warnings() const { return world_warnings_; }
  // Where the windows' keys pass.
  launch::LiveKeysBoard& keys() { return *keys_; }
  launch::LiveRequestsBoard& requests() { return *requests_; }

 private:
  LocalNodes() = default;
  std::unique_ptr<launch::LiveKeysBoard> keys_ = std::make_unique<launch::LiveKeysBoard>();  // the nodes use it
  std::unique_ptr<launch::LiveRequestsBoard> requests_ = std::make_unique<launch::LiveRequestsBoard>();  // likewise
  std::vector<std::unique_ptr<launch::NodeContext>> contexts_;
  std::vector<std::unique_ptr<lockstep::Node>> owned_;
  std::vector<lockstep::Node*> nodes_;
  base::Digest world_hash_ = 0;
  std::vector<std::string> world_warnings_;
};

}  // namespace rodeira::cli

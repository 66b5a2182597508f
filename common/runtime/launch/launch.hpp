// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/runtime/launch/discovery.hpp"
#include "common/runtime/launch/kinds.hpp"
#include "common/runtime/launch/transport.hpp"
#include "common/runtime/lockstep/recovery.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/watchdog.hpp"
#include "idl/topic_table.hpp"

namespace rodeira::launch {

// A node of a launch file.
struct LaunchNode {
  std::string name;
  std::shared_ptr<const NodeKind> kind;
  std::string host;                                     // of a laboratory; empty: the clock's
  std::shared_ptr<const config::Map> config;            // what the node itself reads; may be empty
  lockstep::Policy recovery = lockstep::Policy::kStop;  // what becomes of the run where the node is lost
  std::string process = {};                             // shared with others of this name; empty: its own

  // Driven by a person: what it publishes cannot be computed again.
  bool is_live() const;
  // A program outside Rodeira, with a manifest.
  bool is_external() const { return kind->name == kExternalKind; }
  // A scenario that makes events of what windows ask for.
  bool takes_requests() const;
};

using Overrides = std::vector<std::pair<std::string, std::string>>;

// A launch file (docs/reference/launch-files.md): which nodes take part in a run, on which world, at which rates. Every
// process of a run reads the same file and so comes to the same roster; the roster's hash proves it.
class Launch {
 public:
  // Wrong input where the file is wrong, a kind is unknown, or the wiring is ambiguous or impossible. Keys below
  // `nodes.X.config` are the node's own and are not looked at here.
  static base::Result<Launch> Load(const std::filesystem::path& path, const Overrides& overrides = {});
  // The same of a text; `name` is its file in messages, and relative paths are resolved against its folder.
  static base::Result<Launch> Parse(std::string_view text, const std::filesystem::path& name,
                                    const Overrides& overrides = {});

  const std::filesystem::path& path() const { return file_->path(); }
  const std::string& text() const { return file_->text(); }
  const config::File& file() const { return *file_; }
  const Overrides& overrides() const { return overrides_; }
  const std::string& name() const { return name_; }
  const std::filesystem::path& lab() const { return lab_; }      // laboratory file; empty: none is named
  const std::filesystem::path& world() const { return world_; }  // empty: the run has none
  const std::string& vehicle_model() const {
    return vehicle_model_;
  }  // of cars, in place of their files' own; empty: those
  std::uint64_t seed() const { return seed_; }
  std::optional<double> duration_s() const { return duration_s_; }
  Transport transport() const { return transport_.kind; }
  const TransportSettings& transport_settings() const { return transport_; }
  const Discovery& discovery() const { return discovery_; }
  const std::string& pace() const { return pace_; }  // as --pace takes it; empty: not said
  const lockstep::Watchdog::Settings& watchdog() const { return watchdog_; }
  // Of the clock, and of nodes that say nothing of their own.
  lockstep::Policy recovery() const { return recovery_; }
  std::vector<lockstep::Policy> policies() const;  // one for each node
  // A node that is started again begins at its snapshot and needs what others had said: both are with a recorder. Wrong
  // input where one is to be and there is none.
  base::Status CheckRecovery() const;
  bool keeps_for_restarts() const;  // a node may be started again: recorders answer for all nodes
  const lockstep::Roster& roster() const { return *roster_; }
  // Rodeira's topics, and those that manifests of external nodes add.
  const idl::TopicTable& topics() const { return topics_; }
  const std::vector<LaunchNode>& nodes() const { return nodes_; }  // in the roster's order
  // Precondition: an index of the roster.
  const LaunchNode& node(lockstep::NodeIndex index) const { return nodes_[index]; }

 private:
  static base::Result<Launch> Read(config::File file, const Overrides& overrides);

  std::shared_ptr<config::File> file_;
  Overrides overrides_;
  std::string name_;
  std::filesystem::path lab_;
  std::filesystem::path world_;
  std::string vehicle_model_;
  std::uint64_t seed_ = 0;
  std::optional<double> duration_s_;
  TransportSettings transport_;
  Discovery discovery_;
  std::string pace_;
  lockstep::Watchdog::Settings watchdog_;
  lockstep::Policy recovery_ = lockstep::Policy::kStop;
  std::shared_ptr<const lockstep::Roster> roster_;
  idl::TopicTable topics_;
  std::vector<LaunchNode> nodes_;
};

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/core/ground/ground.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/live_keys.hpp"
#include "common/runtime/launch/live_requests.hpp"
#include "common/runtime/launch/run_log_border.hpp"
#include "common/runtime/lockstep/node.hpp"

namespace rodeira::launch {

// What everybody may know of the run's world without loading it.
struct WorldSummary {
  base::Digest content_hash = 0;
  std::string name;
  double start_x_m = 0.0;  // where the driver's car begins
  double start_y_m = 0.0;
  double start_heading_rad = 0.0;
};

// What a node gets from its host, be that a process of its own or a run in one process.
class NodeContext {
 public:
  NodeContext(const Launch& launch, lockstep::NodeIndex index) : launch_(launch), index_(index) {}
  virtual ~NodeContext() = default;

  const Launch& launch() const { return launch_; }
  const lockstep::Roster& roster() const { return launch_.roster(); }
  lockstep::NodeIndex index() const { return index_; }
  const lockstep::RosterNode& spec() const { return launch_.roster().node(index_); }
  std::uint64_t seed() const { return launch_.seed(); }
  // The node's own keys: `nodes.NAME.config`. After reading them, launch().file().Finish() finds what is wrong there.
  config::Map config() const { return launch_.node(index_).config->OptionalChild("config"); }

  // SUELO of the run's world: remote or in this process, with the same bits.
  virtual ground::Ground& Ground() = 0;
  // It is in this process: asking it costs no round trip.
  virtual bool ground_is_here() const { return false; }
  // From the road server, waited for; Failed where it does not come.
  virtual base::Result<WorldSummary> World() = 0;
  // The keys held in the run's windows, for who has a window and for who drives by them. Null where the host has no
  // such border.
  virtual std::unique_ptr<LiveKeysSender> KeysSender() { return nullptr; }
  virtual std::unique_ptr<LiveKeysReceiver> KeysReceiver() { return nullptr; }
  // What windows ask for in the run, likewise for who asks and for who makes events of it.
  virtual std::unique_ptr<LiveRequestsSender> RequestsSender() { return nullptr; }
  virtual std::unique_ptr<LiveRequestsReceiver> RequestsReceiver() { return nullptr; }
  // What the clock, the operator and faults did on the wall's clock, for who writes it down. Null where the host tells
  // it to nobody.
  virtual std::unique_ptr<RunLogReceiver> RunLog() { return nullptr; }
  // Recovery, as it concerns a recorder. An earlier life of this node has begun the work: its file is gone on with.
  virtual bool is_another_life() const { return false; }
  // What an earlier life has said of its file (see SafeTeller), as the clock knows it; -1: nothing. Failed where the
  // clock is silent.
  virtual base::Result<lockstep::Step> SafeStep() { return lockstep::Step{-1}; }
  // To be told: samples valid through the step lie in the file, nobody needs to keep them for another life of this
  // recorder. Null where the host has no use for it. It outlives this.
  virtual std::function<void(lockstep::Step)> SafeTeller() { return nullptr; }
  // What the file holds already, for other nodes that are lost meanwhile. Wrong input where it contradicts what is
  // known.
  virtual base::Status Remember(const lockstep::Sample& /*sample*/) { return {}; }
  // A sink of another life says behind which step it has everything; its first activation is the next one.
  void BeginBehind(lockstep::Step step) { has_through_ = step; }
  lockstep::Step has_through() const { return has_through_; }
  // A node that has loaded the world says so; all who did must agree.
  void set_world_hash(base::Digest hash) { world_hash_ = hash; }
  base::Digest world_hash() const { return world_hash_; }

 private:
  const Launch& launch_;
  lockstep::NodeIndex index_;
  base::Digest world_hash_ = 0;
  lockstep::Step has_through_ = -1;
};

using NodeFactory = std::function<base::Result<std::unique_ptr<lockstep::Node>>(NodeContext&)>;

// A node that answers questions and waits for nobody (the road server).
class Service {
 public:
  virtual ~Service() = default;
  virtual base::Digest world_hash() const = 0;
  // Said once to everybody who comes, whenever they come: a serialised WorldInfo.
  virtual base::Bytes Announcement() const = 0;
  // A serialised reply to a serialised request, or nothing where the request cannot be read.
  virtual base::Result<base::Bytes> Answer(std::span<const std::byte> request) = 0;
};

using ServiceFactory = std::function<base::Result<std::unique_ptr<Service>>(NodeContext&)>;

}  // namespace rodeira::launch

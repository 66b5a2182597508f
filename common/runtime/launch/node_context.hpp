// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The context of a node: its configuration, seed, ground and world.

#include <functional>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/core/ground/ground.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/live_keys.hpp"
#include "common/runtime/launch/live_requests.hpp"
#include "common/runtime/launch/run_log_border.hpp"
#include "common/runtime/lockstep/node.hpp"

/// Launch files, and what a node gets from the process or the run that hosts it.
namespace rodeira::launch {

/// The world of the run, as far as a node can know it without loading it.
struct WorldSummary {
  base::Digest content_hash = 0;   ///< digest of the world's content
  std::string name;                ///< name of the world
  double start_x_m = 0.0;          ///< start of the driver's car in the world frame W, east
  double start_y_m = 0.0;          ///< start of the driver's car in W, north
  double start_heading_rad = 0.0;  ///< heading at the start, from east, counter-clockwise
};

/// What a node gets from its host: a process of its own, or a run in one process. A node of a laboratory needs
/// config(), seed(), Ground() and World(); the other functions serve nodes of Rodeira, such as windows and recorders.
class NodeContext {
 public:
  /// Makes the context of a node; the host does so.
  /// @param launch launch file of the run; it must outlive the context
  /// @param index index of the node in the roster
  NodeContext(const Launch& launch, lockstep::NodeIndex index) : launch_(launch), index_(index) {}
  virtual ~NodeContext() = default;

  /// Gives the launch file of the run.
  /// @return the launch file
  const Launch& launch() const { return launch_; }
  /// Gives the roster of the run.
  /// @return the roster
  const lockstep::Roster& roster() const { return launch_.roster(); }
  /// Gives the index of the node.
  /// @return index in the roster
  lockstep::NodeIndex index() const { return index_; }
  /// Gives the node's entry in the roster: name, period, ports.
  /// @return the entry
  const lockstep::RosterNode& spec() const { return launch_.roster().node(index_); }
  /// Gives the random seed of the run, the first key of base::RandomBits.
  /// @return the seed
  std::uint64_t seed() const { return launch_.seed(); }
  /// Gives the node's own keys, `nodes.NAME.config` of the launch file. Problems of the keys that the node's factory
  /// reads are found by the host, which calls config::File::Finish afterwards.
  /// @return the mapping; one without keys if the launch file has none
  config::Map config() const { return launch_.node(index_).config->OptionalChild("config"); }

  /// Gives the ground of the run's world: of the ground server (SUELO) or of this process, with the same bits. After
  /// the end of the run it answers "outside".
  /// @return the ground; it outlives the node
  virtual ground::Ground& Ground() = 0;
  /// Says whether the ground is in this process.
  /// @return true: a query costs no round trip
  virtual bool has_local_ground() const { return false; }
  /// Gives the world of the run. Waits for the road server.
  /// @return the world; failed if the road server does not send it
  virtual base::Result<WorldSummary> World() = 0;
  /// Makes a sender of the keys that are held in a window, for nodes with a window.
  /// @return the sender; null if the host has none
  virtual std::unique_ptr<LiveKeysSender> KeysSender() { return nullptr; }
  /// Makes a receiver of the keys that are held in the run's windows, for nodes that are driven by them.
  /// @return the receiver; null if the host has none
  virtual std::unique_ptr<LiveKeysReceiver> KeysReceiver() { return nullptr; }
  /// Makes a sender of an operator's requests, for nodes with a window.
  /// @return the sender; null if the host has none
  virtual std::unique_ptr<LiveRequestsSender> RequestsSender() { return nullptr; }
  /// Makes a receiver of the operators' requests, for the node that turns them into events.
  /// @return the receiver; null if the host has none
  virtual std::unique_ptr<LiveRequestsReceiver> RequestsReceiver() { return nullptr; }
  /// Makes a receiver of the run log, for the recorder: acts of the clock and the operator, and faults, in wall time.
  /// @return the receiver; null if the host has none
  virtual std::unique_ptr<RunLogReceiver> RunLog() { return nullptr; }
  /// Says whether this process continues the work of an earlier one that was lost (for recorders).
  /// @return true: the node was restarted and its file is continued
  virtual bool is_restarted() const { return false; }
  /// Asks the clock for the last step that an earlier process of this recorder has reported as written
  /// (RecordedStepReporter).
  /// @return the step; -1 if none was reported; failed if the clock does not answer
  virtual base::Result<lockstep::Step> LastRecordedStep() { return lockstep::Step{-1}; }
  /// Gives a function by which a recorder reports that all samples valid through a step are in its file. Other nodes
  /// then need not keep them for a restart of the recorder.
  /// @return the function, which may outlive this context; null if the host does not need it
  virtual std::function<void(lockstep::Step)> RecordedStepReporter() { return nullptr; }
  /// Hands over a sample that a continued file already holds, for other nodes that are lost meanwhile.
  /// @param sample the sample
  /// @return wrong input if it contradicts known samples
  virtual base::Status Remember([[maybe_unused]] const lockstep::Sample& sample) { return {}; }
  /// Reports that a restarted sink already has all samples through a step. Its first activation is the next one.
  /// @param step the step
  void BeginBehind(lockstep::Step step) { has_through_ = step; }
  /// Gives the step of BeginBehind.
  /// @return the step; -1 if there was no call
  lockstep::Step has_through() const { return has_through_; }
  /// Reports the content of the world that the node has loaded. All nodes that load it must report the same.
  /// @param hash digest of the world's content
  void set_world_hash(base::Digest hash) { world_hash_ = hash; }
  /// Gives the digest of set_world_hash.
  /// @return the digest; 0 if there was no call
  base::Digest world_hash() const { return world_hash_; }

 private:
  const Launch& launch_;
  lockstep::NodeIndex index_;
  base::Digest world_hash_ = 0;
  lockstep::Step has_through_ = -1;
};

/// A function that makes a node from its context; the argument of RODEIRA_NODE. It reads the configuration. It gives an
/// error if there can be no node, for example if a file is wrong.
using NodeFactory = std::function<base::Result<std::unique_ptr<lockstep::Node>>(NodeContext&)>;

/// A node that answers requests and has no activations (the road server). External nodes are never services.
class Service {
 public:
  virtual ~Service() = default;
  /// Gives the digest of the world's content.
  /// @return the digest
  virtual base::Digest world_hash() const = 0;
  /// Gives the message that every node receives once when it starts.
  /// @return a serialised WorldInfo
  virtual base::Bytes Announcement() const = 0;
  /// Answers a request.
  /// @param request a serialised request
  /// @return a serialised reply; an error if the request cannot be read
  virtual base::Result<base::Bytes> Answer(std::span<const std::byte> request) = 0;
};

/// A function that makes a service from its context.
using ServiceFactory = std::function<base::Result<std::unique_ptr<Service>>(NodeContext&)>;

}  // namespace rodeira::launch

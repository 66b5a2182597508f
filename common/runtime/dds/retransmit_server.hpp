// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/archive.hpp"
#include "common/runtime/lockstep/kept_samples.hpp"
#include "common/runtime/lockstep/pending_nacks.hpp"
#include "common/runtime/lockstep/report.hpp"

namespace rodeira::dds {

// What a node keeps for consumers that lack it, and the thread that sends it to them: while a long answer is on its
// way, the threads that receive go on receiving. Safe for any threads.
class RetransmitServer {
 public:
  // To the requester, from the answering thread, never of two answers at a time.
  using Say = std::function<void(lockstep::NodeIndex requester, std::span<const lockstep::Sample> samples)>;
  // `keeps_all`: as NodeBus. At most `most_bytes` of payload are said at once, or one sample.
  RetransmitServer(const lockstep::Roster& roster, lockstep::NodeIndex node, bool keeps_all, std::size_t most_bytes,
                   Say say);
  ~RetransmitServer();

  // A sample of this node: kept as long as a consumer may ask for it.
  void Keep(const lockstep::Sample& own);
  // Of any node; kept where `keeps_all`. Wrong input where another content is valid at the same step.
  base::Status Remember(const lockstep::Sample& sample);
  // One of those that it has.
  std::optional<lockstep::Sample> Kept(lockstep::SourceIndex source, lockstep::Step step);
  // Drops what no node can lack any more.
  void Granted(const lockstep::Grant& grant);
  // Is answered soon, or passed over where this node has nothing of it.
  void Take(const lockstep::Nack& nack);

 private:
  void Work();
  // What this node has of it, oldest first.
  std::vector<lockstep::Sample> Found(const lockstep::Gap& gap) const;
  void Send(lockstep::NodeIndex requester, std::span<const lockstep::Sample> samples) const;

  std::size_t most_bytes_;
  Say say_;
  std::mutex mutex_;
  std::condition_variable woken_;
  lockstep::KeptSamples kept_;
  std::optional<lockstep::Archive> archive_;
  lockstep::PendingNacks pending_nacks_;
  bool stop_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace rodeira::dds

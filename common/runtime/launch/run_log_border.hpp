// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <vector>

#include "common/runtime/lockstep/run_log.hpp"

// The border over which the clock's log reaches the recorder. No part of the lockstep.
namespace rodeira::launch {

// The recorder's side of the clock's log.
class RunLogReceiver {
 public:
  virtual ~RunLogReceiver() = default;
  // What has come since the last call, whole and in order. Never waits.
  virtual std::vector<lockstep::LogBatch> Take() = 0;
  // Batches before this one are not needed.
  virtual void BeginAt(std::uint64_t number) = 0;
  // Waits for the end of the log; false where it has not come after `limit`. What came by then is Take()'s.
  virtual bool AwaitEnd(std::chrono::milliseconds limit) = 0;
};

// The border within one process. It outlives what it makes.
class RunLogBoard {
 public:
  // It hears what is said from now on. Any thread may call both.
  std::unique_ptr<RunLogReceiver> MakeReceiver();
  void Say(const lockstep::LogBatch& batch);

 private:
  class Receiver;
  std::mutex mutex_;
  std::vector<std::shared_ptr<lockstep::LogInbox>> inboxes_;  // one for each receiver
};

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

// The border over which a window asks for something in the run: a car placed elsewhere, another weather. No part of the
// lockstep: the scenario node turns what it takes at an activation into its own events, and those are what a run
// remembers (law L5).
namespace rodeira::launch {

// What it means: common/driving/scenario/request.hpp.
struct LiveRequest {
  std::uint32_t number = 0;  // counts from 1 in its window
  std::string name, argument;
  double x_m = 0.0, y_m = 0.0;
  double value = 0.0;
};

// One message of a window: what it has not yet seen happen, by number. A lost one does not matter, the next says it
// again.
struct LiveRequestsSaid {
  std::uint64_t window = 0;  // random
  std::vector<LiveRequest> requests;
};

// A window's side: publishes its requests until they are answered.
class LiveRequestsSender {
 public:
  virtual ~LiveRequestsSender() = default;
  // Those that are still wanted, by number; at most kMost. Never waits.
  static constexpr std::size_t kMost = 16;
  // The list replaces the one of the call before.
  virtual void Say(std::vector<LiveRequest> requests) = 0;
};

// The scenario node's side: requests of all windows.
class LiveRequestsReceiver {
 public:
  virtual ~LiveRequestsReceiver() = default;
  // What was asked since the last call, each once, window by window. Never waits.
  virtual std::vector<LiveRequest> Take() = 0;
};

// What the windows have said, each request once. Any thread may call.
class LiveRequestsMemory {
 public:
  // Requests with a number that was heard of their window are passed over.
  void Hear(const LiveRequestsSaid& said);
  std::vector<LiveRequest> Take();

 private:
  std::mutex mutex_;
  std::map<std::uint64_t, std::uint32_t> heard_;  // by window: the newest number
  std::vector<LiveRequest> waiting_;
};

// The border within one process. It outlives what it makes.
class LiveRequestsBoard {
 public:
  // Any thread may call.
  std::unique_ptr<LiveRequestsSender> MakeSender();
  std::unique_ptr<LiveRequestsReceiver> MakeReceiver();

 private:
  class Sender;
  class Receiver;
  void Say(const LiveRequestsSaid& said);
  std::mutex mutex_;
  std::vector<std::shared_ptr<LiveRequestsMemory>> memories_;  // one for each receiver
};

}  // namespace rodeira::launch

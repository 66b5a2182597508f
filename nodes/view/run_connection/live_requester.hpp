// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/driving/scenario/request.hpp"
#include "common/runtime/launch/live_requests.hpp"

namespace rodeira::nodes {

// Sends requests to the run, and repeats each every kRepeat_s until an event of the run confirms it: a message may be
// lost, and a paused run takes none. Used on the thread of the window.
class LiveRequester {
 public:
  static constexpr double kRepeat_s = 0.05;

  explicit LiveRequester(std::unique_ptr<launch::LiveRequestsSender> sender) : sender_(std::move(sender)) {}

  // False where too many wait already, or it can be no event: then nothing is asked.
  bool Request(const scenario::Request& request);
  // What the run has said.
  void See(const std::vector<scenario::Event>& events);
  // Says what is due.
  void Tell(double now_s);
  std::size_t waiting() const { return waiting_.size(); }

 private:
  struct Waiting {
    launch::LiveRequest request;
    scenario::Event becomes;
  };
  std::unique_ptr<launch::LiveRequestsSender> sender_;
  std::vector<Waiting> waiting_;  // by number
  std::uint32_t newest_ = 0;
  bool changed_ = false;
  double told_s_ = -1.0e9;
};

}  // namespace rodeira::nodes

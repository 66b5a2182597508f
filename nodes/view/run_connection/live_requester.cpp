// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/run_connection/live_requester.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::nodes {

bool LiveRequester::Request(const scenario::Request& request) {
  const auto becomes = scenario::EventOf(request);
  if (!becomes || waiting_.size() >= launch::LiveRequestsSender::kMost) return false;
  waiting_.push_back(
      {{++newest_, request.name, request.argument, request.x_m, request.y_m, request.value}, becomes.value()});
  changed_ = true;
  return true;
}

void LiveRequester::See(const std::vector<scenario::Event>& events) {
  for (const scenario::Event& event : events) {
    const auto same = [&](const Waiting& waiting) {
      return waiting.becomes.name == event.name && waiting.becomes.argument == event.argument &&
             waiting.becomes.value == event.value;
    };
    const auto happened = std::find_if(waiting_.begin(), waiting_.end(), same);
    if (happened != waiting_.end()) waiting_.erase(happened);
  }
}

void LiveRequester::Tell(double now_s) {
  if (waiting_.empty() || (!changed_ && now_s - told_s_ < kRepeat_s)) return;
  std::vector<launch::LiveRequest> all;
  for (const Waiting& waiting : waiting_) all.push_back(waiting.request);
  sender_->Say(std::move(all));
  changed_ = false;
  told_s_ = now_s;
}

}  // namespace rodeira::nodes

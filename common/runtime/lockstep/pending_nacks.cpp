// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/pending_nacks.hpp"

namespace rodeira::lockstep {

void PendingNacks::Add(const Nack& nack) {
  const auto& [requester, gap] = nack;
  if (being_answered_ && being_answered_->requester == requester && being_answered_->gap.source == gap.source &&
      being_answered_->gap.from == gap.from)
    return;
  waiting_[{requester, gap.source}] = gap.from;
}

std::optional<Nack> PendingNacks::Next() {
  being_answered_.reset();
  if (waiting_.empty()) return std::nullopt;
  auto next = waiting_.upper_bound(last_);
  if (next == waiting_.end()) next = waiting_.begin();
  last_ = next->first;
  being_answered_ = Nack{next->first.first, {next->first.second, next->second}};
  waiting_.erase(next);
  return being_answered_;
}

}  // namespace rodeira::lockstep

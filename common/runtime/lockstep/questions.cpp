// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/questions.hpp"

namespace rodeira::lockstep {

void Questions::Add(const Question& question) {
  const auto& [asker, gap] = question;
  if (being_answered_ && being_answered_->asker == asker && being_answered_->gap.source == gap.source &&
      being_answered_->gap.from == gap.from)
    return;
  waiting_[{asker, gap.source}] = gap.from;
}

std::optional<Question> Questions::Next() {
  being_answered_.reset();
  if (waiting_.empty()) return std::nullopt;
  auto next = waiting_.upper_bound(last_);
  if (next == waiting_.end()) next = waiting_.begin();
  last_ = next->first;
  being_answered_ = Question{next->first.first, {next->first.second, next->second}};
  waiting_.erase(next);
  return being_answered_;
}

}  // namespace rodeira::lockstep

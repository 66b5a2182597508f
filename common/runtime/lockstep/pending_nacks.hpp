// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// A node that lacks samples, and which.
struct Nack {
  NodeIndex asker = 0;
  Gap gap;
};

// The questions that one process has heard and not answered. An asker repeats itself until it is answered, faster than
// a long answer can be given; so of each asker and source only the newest question stands, and one that is repeated
// while it is being answered was answered. Therefore there are never more than askers times sources, however slow the
// answers are. One thread at a time.
class PendingNacks {
 public:
  // Takes the place of an older question of this asker about the source. The one that is being answered changes
  // nothing.
  void Add(const Nack& question);
  // The next to be answered, of the askers and sources in turn; that one is being answered until the next call. None:
  // all are.
  std::optional<Nack> Next();
  bool empty() const { return waiting_.empty(); }

 private:
  using Key = std::pair<NodeIndex, SourceIndex>;
  std::map<Key, Step> waiting_;  // from which step
  std::optional<Nack> being_answered_;
  Key last_{};
};

}  // namespace rodeira::lockstep

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
  NodeIndex requester = 0;
  Gap gap;
};

// The nacks that one process has received and not answered. A requester repeats a nack until it is answered, faster
// than a long answer can be given. Of each requester and source only the newest nack is kept, and a repeated one is
// dropped while it is being answered. There are never more than requesters times sources, however slow the answers
// are. One thread at a time.
class PendingNacks {
 public:
  // Takes the place of an older nack of this requester about the source. The one that is being answered changes
  // nothing.
  void Add(const Nack& nack);
  // The next to be answered, of the requesters and sources in turn; that one is being answered until the next call.
  // None: all are.
  std::optional<Nack> Next();
  bool empty() const { return waiting_.empty(); }

 private:
  using Key = std::pair<NodeIndex, SourceIndex>;
  std::map<Key, Step> waiting_;  // from which step
  std::optional<Nack> being_answered_;
  Key last_{};
};

}  // namespace rodeira::lockstep

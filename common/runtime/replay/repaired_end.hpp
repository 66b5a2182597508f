// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "common/data/record/repair.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::replay {

// The end of a repaired run (the metadata 'rodeira.end'): the newest step through which every source's samples are all
// there from the first one on. What lies behind a hole stays in the file and is no part of the run any more.
class RepairedEnd final : public record::RepairEnd {
 public:
  std::string_view name() const override { return "rodeira.end"; }
  void Begin(const std::map<record::ChannelId, record::Channel>& channels) override;
  void Keep(const record::Channel& channel, const record::Message& message) override;
  // Nothing where not even the first samples are there.
  record::TextMap Entries(const record::TextMap& found) const override;

 private:
  struct Line {
    lockstep::Step period = 1;
    lockstep::Step next = 0;  // the first valid step that has not been seen
  };
  std::map<record::ChannelId, Line> lines_;
};

}  // namespace rodeira::replay

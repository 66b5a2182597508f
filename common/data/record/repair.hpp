// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/data/record/mcap_types.hpp"

namespace rodeira::record {

// What a repair kept and what it could not.
struct RepairReport {
  bool was_whole = false;
  Statistics kept;
  std::uint64_t source_bytes = 0;
  std::uint64_t target_bytes = 0;
  std::vector<std::string> losses;  // one sentence each: what was lost, and what was found damaged
  bool lost = false;                // false: all that lies in the source was kept, only indexes or its end are new

  // Several lines for a person.
  std::string Text() const;
};

// The name of the metadata record that a repaired file carries (not written where the source was whole).
inline constexpr const char* kRepairMetadata = "rodeira.repair";

// The part that knows what the messages mean, and so at which of them a repaired recording ends: one metadata record is
// written anew.
class RepairEnd {
 public:
  virtual ~RepairEnd() = default;
  virtual std::string_view name() const = 0;
  // All channels that were found, then each message that is kept, in file order.
  virtual void Begin(const std::map<ChannelId, Channel>& channels) = 0;
  virtual void Keep(const Channel& channel, const Message& message) = 0;
  // What the record says then, in place of what was found (empty where it was lost); empty: none is written.
  virtual TextMap Entries(const TextMap& found) const = 0;
};

// Reads what is left of `source` and writes it as a whole recording: `target` appears complete or not at all, and an
// existing target is refused. Where the summary is whole, only damaged chunks are left out; otherwise everything behind
// the first damage is. A source that was whole gives the same messages in the same order and chunks.
// `end` may be null, and is not asked where the source was whole.
base::Result<RepairReport> Repair(const std::filesystem::path& source, const std::filesystem::path& target,
                                  RepairEnd* end = nullptr);

// The same from memory to memory.
base::Result<RepairReport> RepairBytes(base::Bytes source, base::Bytes* target, RepairEnd* end = nullptr);

}  // namespace rodeira::record

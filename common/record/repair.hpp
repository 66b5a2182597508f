#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/bytes.hpp"
#include "common/base/result.hpp"
#include "common/record/mcap_types.hpp"

namespace rodeira::record {

// What a repair kept and what it could not.
struct RepairReport {
  bool was_whole = false;
  Statistics kept;
  std::uint64_t source_bytes = 0;
  std::uint64_t target_bytes = 0;
  std::vector<std::string> losses;  // one sentence each: what was lost, and what was found damaged

  // Several lines for a person.
  std::string Text() const;
};

// The name of the metadata record that a repaired file carries (not written where the source was whole).
inline constexpr const char* kRepairMetadata = "rodeira.repair";

// Reads what is left of `source` and writes it as a whole recording: `target` appears complete or not at all, and an
// existing target is refused. Where the summary is whole, only damaged chunks are left out; otherwise everything behind
// the first damage is. A source that was whole gives the same messages in the same order and chunks.
base::Result<RepairReport> Repair(const std::filesystem::path& source, const std::filesystem::path& target);

// The same from memory to memory.
base::Result<RepairReport> RepairBytes(base::Bytes source, base::Bytes* target);

}  // namespace rodeira::record

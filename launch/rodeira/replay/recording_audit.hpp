// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/data/record/audit.hpp"
#include "common/data/record/mcap_reader.hpp"

namespace rodeira::cli {

// What a recording holds of one source on one topic.
struct RecordedSource {
  std::string topic;
  std::string source;  // the node
  std::string type;
  std::uint64_t samples = 0;
  std::uint64_t bytes = 0;                   // of the payloads
  std::optional<double> rate_hz;             // of simulated time; where the period and the base step are known
  std::optional<record::SourceAudit> audit;  // of samples of the lockstep
  bool ends_early = false;                   // its last sample lies more than a period before the run's end
  std::string type_difference;               // from this program's type of the topic; empty: none, or an unknown topic
  bool without_state = false;                // snapshots that say that the node cannot save its state
  // "lossless", or what is missing; empty where nothing can be said.
  std::string Verdict() const;
  bool lossless() const { return !audit || (audit->whole() && audit->first_step == 0 && !ends_early); }
};

// What a recording holds, and whether all of it is there.
struct RecordingAudit {
  std::vector<RecordedSource> sources;    // by channel
  std::vector<std::string> damages;       // sentences
  base::Digest content = 0;               // of all samples of the lockstep: recordings with the same one are identical
  std::optional<std::int64_t> last_step;  // of the run, as the recorder wrote it at its end
  bool broken_off = false;                // the run came to its end by a fault: what was due last need not be there
  std::optional<std::int64_t> steps_without_wall_time;  // of the run; none where the file has no wall times at all
  bool has_every_sample() const;                        // up to its end, wherever that is
  bool lossless() const;                                // and nothing is damaged
};

// Reads every message once. Messages of a channel with a period are samples of the lockstep: one a period was
// expected, from step 0 to the run's end where that was reached.
RecordingAudit Audit(const record::McapReader& reader);

}  // namespace rodeira::cli

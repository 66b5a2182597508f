// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rodeira::record {

// Two recorded steps of a source with samples missing between them.
struct StepGap {
  std::uint64_t after_step = 0;
  std::uint64_t next_step = 0;
  bool operator==(const StepGap&) const = default;
};

// One source on one topic. A source publishes one sample a period (law L1), so its steps are evenly spaced.
struct SourceAudit {
  std::uint64_t first_step = 0;
  std::uint64_t last_step = 0;
  std::uint64_t count = 0;
  std::uint64_t period_steps = 0;  // as declared, or else the smallest distance seen; 0 with fewer than two samples
  std::uint64_t missing = 0;       // samples that the gaps left out, Σ (distance / period − 1), rounded up
  std::uint64_t repeated = 0;      // the same step again
  std::uint64_t backward = 0;      // a smaller step after a larger one
  std::vector<StepGap> gaps;       // distances other than the period, the first hundred
  bool whole() const { return missing == 0 && repeated == 0 && backward == 0 && gaps.empty(); }
};

// Follows (source, step) pairs in the order of each source's steps and says where samples are missing.
class StepAudit {
 public:
  using Key = std::pair<std::string, std::uint64_t>;  // topic, source

  // Says how far apart the steps of a source are. Without it the smallest distance seen counts.
  void Declare(const std::string& topic, std::uint64_t source, std::uint64_t period_steps);
  // The next step of the source, in the order in which it stands in the recording.
  void Add(const std::string& topic, std::uint64_t source, std::uint64_t step);
  // What has been found so far; more may follow.
  std::map<Key, SourceAudit> Finish() const;

 private:
  struct Track {
    std::uint64_t declared = 0;
    std::uint64_t repeated = 0;
    std::uint64_t backward = 0;
    std::uint64_t count = 0;
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::map<std::uint64_t, std::uint64_t> distances;        // distance → how often
    std::map<std::uint64_t, std::vector<StepGap>> examples;  // distance → its first hundred places
  };
  std::map<Key, Track> tracks_;
};

}  // namespace rodeira::record

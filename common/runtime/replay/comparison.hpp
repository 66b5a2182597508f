// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/launch/sample_difference.hpp"
#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::replay {

// Where a run that is computed again first differs from its recording.
struct Difference {
  lockstep::Step step = 0;
  std::string node;
  std::string topic;
  std::string field;  // of the sample, or of the node's state where "state." stands before it
  std::string recorded;
  std::string computed;

  // One sentence, with recorded and computed value.
  std::string Text() const;
};

// Compares samples as they are computed with the recorded ones: the payload to the bit, with the digest of the node's
// state that it carries, and snapshots field by field. Samples of one source come in their order, sources in any.
class Comparison {
 public:
  // Samples valid before `from` are not compared. `trusted`: nodes with samples from the recording itself.
  Comparison(const RecordedRun& run, lockstep::Step from, const std::vector<bool>& trusted);

  // A sample that the run has computed; the first difference by step and source is kept.
  void Take(const lockstep::Sample& computed);
  // Once all nodes have stopped: samples that were recorded up to `through`, and were not computed, are a difference
  // too.
  void Finish(lockstep::Step through);

  bool differs() const { return first_.has_value() || problem_.has_value(); }
  const std::optional<Difference>& first() const { return first_; }
  // The recording itself could not be read on.
  const std::optional<base::Error>& problem() const { return problem_; }
  std::uint64_t compared() const { return compared_; }
  std::uint64_t snapshots_compared() const { return snapshots_; }

 private:
  std::optional<lockstep::Sample> Recorded(lockstep::SourceIndex source, lockstep::Step valid);
  bool ReadOne();
  void Note(const lockstep::Sample& sample, std::string field, std::string recorded, std::string computed);
  void Compare(const lockstep::Sample& recorded, const lockstep::Sample& computed);

  const RecordedRun& run_;
  lockstep::Step from_;
  std::vector<bool> trusted_;  // by node
  SampleStream stream_;
  std::vector<std::deque<lockstep::Sample>> waiting_;  // of each source, read and not yet compared
  launch::SampleDifference differences_;
  std::optional<Difference> first_;
  std::pair<lockstep::Step, lockstep::SourceIndex> first_at_;
  std::optional<base::Error> problem_;
  std::uint64_t compared_ = 0;
  std::uint64_t snapshots_ = 0;
  bool over_ = false;
};

}  // namespace rodeira::replay

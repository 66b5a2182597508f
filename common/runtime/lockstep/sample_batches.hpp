// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// How a consumer gets a source's samples. A node that is activated at least as often as the source publishes gets each
// one by itself. One that is activated more seldom gets batches: at activation k it will see, of a state, one sample
// alone, of events, all since the activation before; so the producer keeps them together until the sample is there that
// is the newest at a multiple of the consumer's period. That is also the one that the consumer waits for: no node waits
// longer than for single samples.
bool GetsSampleBatches(const Roster& roster, SourceIndex source, NodeIndex consumer);

// A producer's samples on their way to those of its consumers that get batches. A batch that is lost is asked for, as
// a sample is.
class SampleBatches {
 public:
  // With `most_bytes` of payload in it a batch is complete, whatever else will come.
  SampleBatches(const Roster& roster, NodeIndex producer, std::size_t most_bytes);

  // For one consumer.
  struct SampleBatch {
    NodeIndex to = 0;
    std::vector<Sample> samples;  // in the order in which they were added
  };
  // The batches that are complete with this sample, of the consumers in ascending order. `last`: the run's last step
  // where it is known, behind which nothing comes.
  std::vector<SampleBatch> Add(const Sample& sample, Step last);
  // Whether a consumer gets each of its samples by itself.
  bool IsSentAlone(SourceIndex source) const;
  // The consumers that get batches, ascending.
  std::vector<NodeIndex> Consumers() const;

 private:
  struct Line {  // one source to one consumer
    SourceIndex source = 0;
    bool events = false;
    Step period = 1;  // the consumer's
  };
  struct Recipient {
    NodeIndex node = 0;
    std::vector<Line> lines;
    std::vector<Sample> waiting;
    std::size_t waiting_bytes = 0;
  };

  const Roster& roster_;
  std::size_t most_bytes_;
  std::vector<Recipient> recipients_;
  std::vector<SourceIndex> alone_;
};

}  // namespace rodeira::lockstep

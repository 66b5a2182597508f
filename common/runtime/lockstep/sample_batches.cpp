// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/sample_batches.hpp"

#include <algorithm>

namespace rodeira::lockstep {
namespace {

// The sample valid at `step` is the newest one at an activation of its consumer.
bool IsSeen(Step step, Step source_period, Step consumer_period) {
  return CeilTo(step, consumer_period) < step + source_period;
}

}  // namespace

bool GetsSampleBatches(const Roster& roster, SourceIndex source, NodeIndex consumer) {
  return roster.node(consumer).period > roster.source(source).period;
}

SampleBatches::SampleBatches(const Roster& roster, NodeIndex producer, std::size_t most_bytes)
    : roster_(roster), most_bytes_(most_bytes) {
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    Recipient recipient{n, {}, {}, 0};
    for (const Port& port : roster.node(n).inputs) {
      for (const SourceIndex source : port.sources) {
        if (roster.source(source).node != producer) continue;
        if (!GetsSampleBatches(roster, source, n))
          alone_.push_back(source);
        else
          recipient.lines.push_back({source, port.kind == PortKind::kEvent, roster.node(n).period});
      }
    }
    if (!recipient.lines.empty()) recipients_.push_back(std::move(recipient));
  }
}

std::vector<SampleBatches::SampleBatch> SampleBatches::Add(const Sample& sample, Step last) {
  std::vector<SampleBatch> complete;
  const Step period = roster_.source(sample.source()).period;
  for (Recipient& to : recipients_) {
    for (const Line& line : to.lines) {
      if (line.source != sample.source()) continue;
      const bool seen = IsSeen(sample.valid(), period, line.period) || sample.valid() > last - period;
      if (!line.events && !seen) continue;
      to.waiting.push_back(sample);
      to.waiting_bytes += sample.payload->size();
      if (!seen && to.waiting_bytes < most_bytes_) continue;
      complete.push_back({to.node, std::move(to.waiting)});
      to.waiting.clear();
      to.waiting_bytes = 0;
    }
  }
  return complete;
}

bool SampleBatches::IsSentAlone(SourceIndex source) const {
  return std::find(alone_.begin(), alone_.end(), source) != alone_.end();
}

std::vector<NodeIndex> SampleBatches::Consumers() const {
  std::vector<NodeIndex> nodes;
  for (const Recipient& to : recipients_) nodes.push_back(to.node);
  return nodes;
}

}  // namespace rodeira::lockstep

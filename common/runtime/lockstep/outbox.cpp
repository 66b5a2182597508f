// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/outbox.hpp"

#include <utility>

#include "common/core/base/assert.hpp"
#include "common/core/base/recycled_bytes.hpp"

namespace rodeira::lockstep {

Outbox::Outbox(const Roster& roster, NodeIndex node)
    : roster_(roster), node_(node), payloads_(roster.node(node).outputs.size()) {}

void Outbox::Put(std::string_view topic, base::Bytes payload) {
  const auto& outputs = roster_.node(node_).outputs;
  RODEIRA_ASSERT(SampleHeader::HasHeader(payload));
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (roster_.source(outputs[i]).topic != topic) continue;
    RODEIRA_ASSERT(payloads_[i].empty());  // exactly one sample a period
    payloads_[i] = std::move(payload);
    return;
  }
  RODEIRA_ASSERT(false && "a node publishes a topic that the roster does not know of it");
}

std::vector<Sample> Outbox::Take(Step valid, std::uint32_t incarnation, base::Digest state_digest) {
  std::vector<Sample> samples;
  TakeInto(valid, incarnation, state_digest, samples);
  return samples;
}

void Outbox::TakeInto(Step valid, std::uint32_t incarnation, base::Digest state_digest, std::vector<Sample>& samples) {
  const auto& outputs = roster_.node(node_).outputs;
  samples.clear();
  samples.reserve(outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    RODEIRA_ASSERT(!payloads_[i].empty());  // exactly one sample a period, an empty batch if there is nothing to say
    const SampleHeader header{valid, valid * roster_.base_step_ns(), outputs[i], incarnation, state_digest};
    header.Write(payloads_[i]);
    samples.push_back({header, base::ShareBytes(std::move(payloads_[i]))});
    payloads_[i].clear();
  }
}

}  // namespace rodeira::lockstep

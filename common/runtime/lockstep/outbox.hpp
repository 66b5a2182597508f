// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// Takes what a node publishes at one activation: exactly one payload for each of its outputs.
class Outbox {
 public:
  Outbox(const Roster& roster, NodeIndex node);

  // A serialised sample, encapsulation bytes included; the header is filled in by the runner.
  void Put(std::string_view topic, base::Bytes payload);

  // For the runner: all samples, headers written, in the order of the node's outputs; empties the box. A missing or
  // second payload is the node's mistake.
  std::vector<Sample> Take(Step valid, std::uint32_t incarnation, base::Digest state_digest);

 private:
  const Roster& roster_;
  NodeIndex node_;
  std::vector<base::Bytes> payloads_;
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Outputs of a node.

#include <string_view>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

/// The outputs of a node at one activation: exactly one payload for each of its output topics.
class Outbox {
 public:
  /// Makes an empty outbox; the runner does so, a test for its node.
  /// @param roster roster with the node's outputs; it must outlive the outbox
  /// @param node index of the node in the roster
  Outbox(const Roster& roster, NodeIndex node);

  /// Publishes a sample. A topic that is no output of the node, and a second payload of a topic, are assertion
  /// failures.
  /// @param topic name of the topic
  /// @param payload a serialised sample of idl::Encode, with encapsulation bytes; the runner fills in the header
  void Put(std::string_view topic, base::Bytes payload);

  /// Takes all samples and empties the outbox; the runner calls it. A missing payload is an assertion failure.
  /// @param valid step at which the samples are valid
  /// @param incarnation number of the node's restarts
  /// @param state_digest digest of the node's state after the activation
  /// @return the samples with their headers, in the order of the node's outputs
  std::vector<Sample> Take(Step valid, std::uint32_t incarnation, base::Digest state_digest);
  /// The same into a vector that is used again.
  /// @param valid step at which the samples are valid
  /// @param incarnation number of the node's restarts
  /// @param state_digest digest of the node's state after the activation
  /// @param samples receives the samples with their headers, in the order of the node's outputs, instead of its content
  void TakeInto(Step valid, std::uint32_t incarnation, base::Digest state_digest, std::vector<Sample>& samples);

 private:
  const Roster& roster_;
  NodeIndex node_;
  std::vector<base::Bytes> payloads_;
};

}  // namespace rodeira::lockstep

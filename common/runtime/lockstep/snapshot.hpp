// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// A node at step s (law L3): its state before the first activation at or after s, and of its own samples all that any
// consumer may still ask for. Inboxes follow from the others' snapshots.
struct Snapshot {
  NodeIndex node = 0;
  Step at = 0;
  base::Bytes state;            // StateWriter, with names
  std::vector<Sample> samples;  // ordered by step, then by source
  std::uint64_t steps = 0;      // activations done before
  base::Digest digest = 0;      // the chain of samples so far
  bool has_state = true;        // false: of a node that cannot save its state (Node::can_save); `state` is empty then

  base::Bytes Encode() const;
  // As a sample of the snapshot source (idl/snapshot.idl): CDR with the header, this, and padding of zeros.
  Sample ToSample(const Roster& roster, std::uint32_t incarnation) const;
  // Wrong input where the payload is no snapshot.
  static base::Result<Snapshot> FromSample(std::span<const std::byte> payload);
  // Wrong input: cut short, of another node's shape, or left-over bytes.
  static base::Result<Snapshot> Decode(std::span<const std::byte> bytes);
};

// Whether both samples hold snapshots that are equal but for incarnations and carried fields (base::kCarried). False
// for samples of other kinds.
bool SameSnapshots(const Sample& a, const Sample& b);

}  // namespace rodeira::lockstep

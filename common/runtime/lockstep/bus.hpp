// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/sample.hpp"
#include "common/runtime/lockstep/snapshot.hpp"

namespace rodeira::lockstep {

// What a runner needs of a network. Incoming samples and grants go into the node's Mailbox from any thread.
class Bus {
 public:
  virtual ~Bus() = default;
  // Sends a sample to every node that is wired to its source. It may be lost: then its consumer sends a nack.
  virtual base::Status Publish(const Sample& sample) = 0;
  // Requests retransmission of a source's samples from `gap.from` on by the node that keeps them. The nack may be lost,
  // too; the runner repeats it as long as samples are missing.
  virtual void SendNack(const Gap& gap) = 0;
  // Sends a report to the clock.
  virtual void Tell(const Report& report) = 0;
  // Sends a snapshot to the node that keeps snapshots; the default discards it.
  virtual void Keep(const Snapshot& /*snapshot*/) {}
};

}  // namespace rodeira::lockstep

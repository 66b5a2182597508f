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
  // To every node that is wired to the sample's source. It may be lost on its way: then its consumer asks for it.
  virtual base::Status Publish(const Sample& sample) = 0;
  // The consumer lacks samples of this source, `gap.from` and what follows: the node that keeps them repeats them. The
  // nack may be lost too; it is put again as long as the samples are missing.
  virtual void SendNack(const Gap& gap) = 0;
  // To the clock.
  virtual void Tell(const Report& report) = 0;
  // To the node that keeps snapshots; the default keeps none.
  virtual void Keep(const Snapshot& /*snapshot*/) {}
};

}  // namespace rodeira::lockstep

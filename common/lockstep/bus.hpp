#pragma once

#include "common/lockstep/report.hpp"
#include "common/lockstep/sample.hpp"
#include "common/lockstep/snapshot.hpp"

namespace rodeira::lockstep {

// What a runner needs of a network. Incoming samples and grants go into the node's Mailbox from any thread.
class Bus {
 public:
  virtual ~Bus() = default;
  // Reliably, to every node that is wired to the sample's source.
  virtual base::Status Publish(const Sample& sample) = 0;
  // To the clock.
  virtual void Tell(const Report& report) = 0;
  // To whoever keeps snapshots; the default keeps none.
  virtual void Keep(const Snapshot& /*snapshot*/) {}
};

}  // namespace rodeira::lockstep

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "common/core/base/result.hpp"
#include "common/runtime/dds/local_exchange.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/node_context.hpp"

namespace rodeira::dds {

// What a process is to a node that it hosts. All outlives the node.
struct PartHost {
  const launch::Launch& launch;
  Participant& participant;
  const DomainSettings& domain;
  LocalExchange* exchange = nullptr;  // null: the node is alone
  bool has_sink = false;              // the process has a file to close
};

// A node of a run in this process: its mailbox, its bus, and its way from the start to the end. It has reported to the
// clock from the time on when it was opened.
class HostedPart {
 public:
  virtual ~HostedPart() = default;
  // Makes the node. What goes wrong is told in Run().
  virtual void Make() = 0;
  // To the end; the calling thread is the node's own. 0, 1 or 2.
  virtual int Run() = 0;
};

// A node with activations.
base::Result<std::unique_ptr<HostedPart>> OpenNode(const PartHost& host, lockstep::NodeIndex index,
                                                   std::uint32_t incarnation, launch::NodeFactory factory);
// A server.
base::Result<std::unique_ptr<HostedPart>> OpenService(const PartHost& host, lockstep::NodeIndex index,
                                                      std::uint32_t incarnation, launch::ServiceFactory factory);

}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <thread>

#include "common/runtime/dds/participant.hpp"

namespace rodeira::dds {

// Receives the clock's grants over a participant of its own. For a process with a receive thread that is held up, as by
// a step that hangs: everything else that the clock says waits behind it.
class GrantListener {
 public:
  // Returns at once: the participant is opened on another thread, where it can take as long as it likes. Where it
  // cannot be opened, nothing is received.
  GrantListener(const DomainSettings& settings, OnPayload on_grant);
  ~GrantListener();
  GrantListener(const GrantListener&) = delete;
  GrantListener& operator=(const GrantListener&) = delete;

 private:
  void Open(DomainSettings settings, OnPayload on_grant);

  std::unique_ptr<Participant> participant_;  // outlives the reader
  std::unique_ptr<Reader> grants_;
  std::thread thread_;
};

}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/lockstep/run_log.hpp"

namespace rodeira::dds {

// Tells external recorders of the start, the end and each marker of a run (idl/trigger.idl).
class Triggers {
 public:
  // `run`: the run's name, in each trigger. Fails as Participant::MakeWriter does.
  static base::Result<Triggers> Open(Participant& participant, std::string run, std::int64_t base_step_ns);
  // Start and markers; other remarks are no business of theirs.
  void Say(const lockstep::Remark& remark);
  // "ok", or the fault.
  void SayEnd(lockstep::Step step, std::int64_t utc_ns, const std::string& how);

 private:
  Triggers(std::unique_ptr<Writer> writer, std::string run, std::int64_t base_step_ns);
  void Write(std::uint32_t code, lockstep::Step step, std::int64_t utc_ns, const std::string& text);

  std::unique_ptr<Writer> writer_;
  std::string run_;
  std::int64_t base_step_ns_;
  std::uint64_t number_ = 0;
};

}  // namespace rodeira::dds

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::nodes {

// An end in the middle of a run, by a cause that is named in the configuration: what a run makes of it is tested with
// real processes.
class SuddenEnd {
 public:
  // Keys: `end_at_step` (-1: never); `end_by`: failure, exit_0, exit_1, exception, assertion, memory (of the
  // process) or memory_of_group (of its control group); `end_once`: a
  // file that is made at the end, and while it is there the node goes on (a restarted one does).
  static SuddenEnd Read(const config::Map& config);

  // At another step: nothing. At that step: the failure, or no return.
  base::Status At(lockstep::Step step) const;

 private:
  bool IsFirst() const;
  lockstep::Step step_ = -1;
  std::string cause_;
  std::filesystem::path once_;
};

}  // namespace rodeira::nodes

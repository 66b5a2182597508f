// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"

namespace rodeira::fmi {

// How long the trial's process may take.
struct TrialLimits {
  std::chrono::seconds cpu{10};   // computed
  std::chrono::seconds wall{40};  // waited for
};

// Tries an FMU in a process of its own, the program rodeira-fmu-trial: loads its binary, makes an instance, initialises
// and frees it. `folder`: where the FMU is unpacked; `file`: its path for messages. The program ends with this process.
//
// Wrong input if the FMU's code crashes, ends the process, makes no instance, or exceeds a limit: the message names the
// function. Failed if the program cannot be started. Another error that the FMU itself reports is no failure of the
// trial: the caller meets it again.
base::Status TryInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                  const TrialLimits& limits = {});
// Tries whether a state of the FMU outlives its process: one process takes some steps, saves it and goes on, another
// one sets it and goes on. Wrong input, too, where their outputs differ: some solvers begin anew with a state.
// Precondition: the FMU offers states and passed the trial above.
base::Status TryStateInProcessOfItsOwn(const std::filesystem::path& folder, const std::string& file,
                                       const TrialLimits& limits = {});

// The descriptor that the program writes to.
constexpr int kTrialDescriptor = 3;

// main of rodeira-fmu-trial FOLDER FILE CPU_SECONDS [save|set STATE_FILE]: writes each function's name to
// kTrialDescriptor before it calls it, "refused: WHY" where the FMU makes no instance or takes no state, and an empty
// line at the end. Exit status 0, whatever the FMU returns; 2 without these arguments.
int RunTrial(int argc, char** argv);

}  // namespace rodeira::fmi

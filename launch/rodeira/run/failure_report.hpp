// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/run/part_log.hpp"

namespace rodeira::cli {

// A part of a run that failed.
struct FailedPart {
  std::string name;
  std::string fate;  // "left with status 1", "was killed by signal 9 (Killed)"
  const PartLog* log = nullptr;
};

// Everything known of a failed run, as text: the fault, versions, the machine, command line changes, the launch file,
// and the last lines of each part (with its backtrace, if it crashed).
std::string FailureText(const std::string& fault, const launch::Launch& launch, const std::vector<FailedPart>& parts);

// File of the report: RECORDING-failure.txt beside `recording`; without one a dated name among the user's recordings.
std::filesystem::path FailureFile(const std::string& recording, const std::string& launch_name);

}  // namespace rodeira::cli

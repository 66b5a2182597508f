// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/doctor/finding.hpp"

namespace rodeira::cli {

// `rodeira doctor …`: is this PC ready?
struct DoctorOptions {
  std::string transport = "shared_memory";
  std::uint32_t domain = 0;
  bool quiet = false;
  bool clean = false;
  bool devices = false;  // print only what the joysticks are: VERDICT, a tab, the sentence
  std::string answer;    // be the second process of the DDS loop-back, in this run, …
  std::uint32_t segment_kib = launch::TransportSettings::kSegmentKib;  // … with this segment
};

// One line of the table, with its line break; after PrintErrorsAsJson: an object with id (null: it is well), check,
// verdict and message.
std::string FindingLine(const Finding& finding);
// 0, or 1 where there is a fault.
int StatusOf(std::span<const Finding> findings);

// Prints a line a check (with --quiet only warnings and faults). The exit status comes back.
int Doctor(const DoctorOptions& options);

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/lab.hpp"
#include "launch/rodeira/run/run_command.hpp"

namespace rodeira::cli {

// What of a run belongs to this PC: everything, unless --host and a laboratory file say less.
class Placement {
 public:
  // Fills in what the laboratory says: run and domain where the command line names none, and `overrides` for all
  // processes of this PC. Wrong input: an unknown host, one without anything to do, one with an address that this PC
  // does not have; options that belong to another host.
  static base::Result<Placement> Find(const launch::Launch& launch, RunOptions& options, launch::Overrides& overrides);

  bool has_clock() const { return !lab_ || lab_->clock() == host_; }
  // Whether the node runs on this PC.
  bool Has(const launch::LaunchNode& node) const { return !lab_ || lab_->HostOf(node) == host_; }
  const std::string& host() const { return host_; }  // empty: there is one PC
  // "host 'left' (192.168.10.1)", of the clock.
  std::string ClocksPlace() const;

 private:
  std::optional<launch::Lab> lab_;
  std::string host_;
};

}  // namespace rodeira::cli

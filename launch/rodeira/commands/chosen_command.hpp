// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::cli {

// The command that the command line names. The parser sets it; the front door runs it when all options are read.
class ChosenCommand {
 public:
  // `run` does `command` and returns the exit status. It holds the options that the parser writes into, so that they
  // live as long as the parser. At most once for each command; this object must live as long as the parser.
  void When(CLI::App& command, std::function<int()> run) {
    command.callback([this, run = std::move(run)] { run_ = run; });
  }

  // The exit status. Precondition: the parser has accepted a command line that names a command.
  int Run() const {
    RODEIRA_ASSERT(run_ != nullptr);
    return run_();
  }

 private:
  std::function<int()> run_;
};

}  // namespace rodeira::cli

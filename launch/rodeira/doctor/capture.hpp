// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rodeira::cli {

// How a child process ended, with all that it wrote to standard output and error.
struct Captured {
  std::optional<int> status;  // none where it was killed
  bool too_late = false;      // it was killed because its time was over
  std::string output;

  bool well() const { return status == 0; }
  // The first line of the output, for a sentence.
  std::string FirstLine() const;
};

// Runs `body` in a fork of this process and waits for its end, at most `limit`; what it returns is the exit status.
Captured CaptureFork(const std::function<int()>& body, std::chrono::milliseconds limit);
// The same of another program; status 127 where it cannot be started.
Captured CaptureProgram(const std::vector<std::string>& command, std::chrono::milliseconds limit);

}  // namespace rodeira::cli

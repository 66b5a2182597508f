// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace rodeira::launch {

// The run's control socket (docs/reference/run-control.md), as a window asks it: what it says is an operator's word, no
// sample. It has no thread.
class RunControlClient {
 public:
  // `rodeira run` names the socket to its processes by this variable of their environment.
  static constexpr const char* kVariable = "RODEIRA_CONTROL";
  // Null where the variable is not set or no clock listens: it is on another PC.
  static std::unique_ptr<RunControlClient> Open();
  ~RunControlClient();
  RunControlClient(const RunControlClient&) = delete;
  RunControlClient& operator=(const RunControlClient&) = delete;

  // A command as `rodeira ctl` has it. Never waits; what cannot be sent is not asked.
  void Send(const std::string& command);
  // The next answer, in the order of what was asked: "ok paused at 1.234 s (step 1234)". Never waits.
  std::optional<std::string> Answer();

 private:
  explicit RunControlClient(int file) : file_(file) {}
  int file_;
  std::string pending_;
};

}  // namespace rodeira::launch

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::dds {

// A node that was lost: its process was told to end, died or was stopped.
struct LostNode {
  std::string node;
  std::uint32_t incarnation = 0;
  std::string text;  // goes on after "node 'x' …"
};

// What `rodeira run` writes to the standard input of the clock that it started, a line each:
//   lost NODE INCARNATION TEXT   a process of this PC died or was stopped; seen sooner than by any heartbeat
//   exited NODE INCARNATION TEXT a process of this PC has ended by itself: why its node will be silent, if it is
//   do NUMBER COMMAND            an operator's command
//   abort                        an orderly stop takes too long
// Other lines are ignored. All functions from any thread.
class SupervisorPipe {
 public:
  SupervisorPipe() = default;
  SupervisorPipe(const SupervisorPipe&) = delete;
  SupervisorPipe& operator=(const SupervisorPipe&) = delete;
  ~SupervisorPipe();  // ends the thread

  // Reads `descriptor` on a thread of its own, once. `on_line` is called on that thread after each line that counts,
  // and when the other end is closed.
  base::Status Listen(int descriptor, std::function<void()> on_line);

  std::vector<LostNode> TakeLost();         // each once
  std::vector<LostNode> TakeExited();       // each once
  std::vector<std::string> TakeCommands();  // "NUMBER COMMAND", each once
  bool must_abort() const;
  // The other end is closed: `rodeira run` has ended, however it did.
  bool is_closed() const;
  // There is something that was not taken.
  bool is_waiting() const;

 private:
  void Read(int descriptor, const std::function<void()>& on_line);
  bool Take(std::string_view line);

  mutable std::mutex mutex_;
  std::vector<LostNode> lost_, exited_;
  std::vector<std::string> commands_;
  bool must_abort_ = false;
  bool is_closed_ = false;
  int stop_[2] = {-1, -1};  // a pipe: the thread ends when it is closed
  std::thread thread_;
};

// "NODE INCARNATION TEXT"; nothing where it is not of that form.
std::optional<LostNode> ParseLostNode(std::string_view text);

}  // namespace rodeira::dds

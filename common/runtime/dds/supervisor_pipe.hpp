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
#include "common/runtime/lockstep/report.hpp"

namespace rodeira::dds {

// A node that was lost: its process was told to end, died or was stopped.
struct LostNode {
  std::string node;
  std::uint32_t incarnation = 0;
  std::string text;  // goes on after "node 'x' …"
};

// How a node says that it ended: a line on its process' standard error, which needs no network and is there when the
// process is gone. Whatever started the process passes it on to the clock.
struct LastWord {
  std::string node;
  std::uint32_t incarnation = 0;
  lockstep::Phase phase = lockstep::Phase::kFailed;  // kFailed, kRefused or kLost
  lockstep::Step step = 0;                           // the next activation
  std::string text;                                  // as Report::message
};
// The line begins with it; "PHASE STEP TEXT" follows.
inline constexpr std::string_view kLastWord = "rodeira: end: ";
// The same of one of several nodes of a process: this, NODE, "': " and the rest.
inline constexpr std::string_view kLastWordOfNode = "rodeira: end of node '";
// Writes the line where the report is that of a node which failed, was refused or told to end; else nothing. `node` is
// empty in a process of one node.
void WriteLastWord(const lockstep::Report& report, std::string_view node = {});
// "NODE INCARNATION PHASE STEP TEXT"; nothing where it is not of that form.
std::optional<LastWord> ParseLastWord(std::string_view text);

// What `rodeira run` writes to the standard input of the clock that it started, a line each:
//   lost NODE INCARNATION TEXT   a process of this PC died, was stopped or left without a last word
//   said NODE INCARNATION PHASE STEP TEXT  the last word of a process of this PC
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
  std::vector<LastWord> TakeLastWords();    // each once
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
  std::vector<LostNode> lost_;
  std::vector<LastWord> last_words_;
  std::vector<std::string> commands_;
  bool must_abort_ = false;
  bool is_closed_ = false;
  int stop_[2] = {-1, -1};  // a pipe: the thread ends when it is closed
  std::thread thread_;
};

// "NODE INCARNATION TEXT"; nothing where it is not of that form.
std::optional<LostNode> ParseLostNode(std::string_view text);

}  // namespace rodeira::dds

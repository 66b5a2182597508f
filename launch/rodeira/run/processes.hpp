// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "launch/rodeira/run/part_log.hpp"

namespace rodeira::cli {

// The signal that has killed a process of which no code runs any more, though it has not ended: the first thread is a
// zombie, and another one gets no processor to end on. On a busy PC that lasts for seconds where a library runs a
// thread by SCHED_IDLE, as Mesa does for its cache of shaders. 0: not so, or another user's process.
int KilledBy(pid_t pid);

// A child process of `rodeira run`, in a process group of its own (a terminal's Ctrl-C reaches only the parent), told
// by SIGTERM when the parent dies, however it dies.
class Child {
 public:
  // With pipes for standard input and output only if `with_pipes`. Standard error goes into `log`, read by Poll, or is
  // the parent's if `log` is null; the log outlives the child.
  static base::Result<Child> Start(const std::string& name, const std::vector<std::string>& command, bool with_pipes,
                                   PartLog* log = nullptr);

  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  // Looks, without waiting, what it has written and whether it has ended or been stopped.
  void Poll();
  void Signal(int number) const;  // nothing where it has ended

  const std::string& name() const { return name_; }
  pid_t pid() const { return pid_; }
  bool ended() const { return ended_; }
  std::chrono::steady_clock::time_point ended_at() const { return ended_at_; }  // when Poll saw it
  bool stopped() const { return stopped_; }
  // By a signal; its last threads may still be ending (KilledBy).
  bool killed() const { return kill_signal_ != 0; }
  std::optional<int> exit_status() const { return exit_status_; }  // where it left by itself
  // "was killed by signal 9 (Killed)", "left with status 1", "was stopped by signal 19 (Stopped)". A crash in foreign
  // code is named: "was killed by signal 11 (Segmentation fault) in fmi2DoStep of FMU '/a/car.fmu' (instance 'b')".
  std::string Fate() const;
  // It said so before it ended (base::ForeignCall).
  bool ended_by_foreign_code() const { return ended_ && log_ != nullptr && !log_->crash_place().empty(); }
  // What one of its nodes has said of its own end (PartLog::LastWordOf); empty: nothing, or it has no log.
  std::string LastWordOf(const std::string& node) const { return log_ == nullptr ? "" : log_->LastWordOf(node); }
  // Of several nodes the one that it crashed in (PartLog::crash_node); empty: not known.
  std::string crash_node() const { return log_ == nullptr ? "" : log_->crash_node(); }
  int out() const { return out_; }           // to read from; -1 without pipes
  void Send(const std::string& line) const;  // to its standard input
  // The child reads the end of its standard input.
  void CloseInput();

 private:
  Child() = default;
  void Close();
  std::string name_;
  pid_t pid_ = -1;
  int in_ = -1;
  int out_ = -1;
  int error_ = -1;  // its standard error, with a log
  PartLog* log_ = nullptr;
  bool ended_ = false;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point ended_at_;
  int stop_signal_ = 0;
  int kill_signal_ = 0;
  std::optional<int> exit_status_;
  std::uint64_t memory_kills_at_start_ = 0;
  bool for_memory_ = false;  // killed, and the kernel has killed for lack of memory since it was started
};

}  // namespace rodeira::cli

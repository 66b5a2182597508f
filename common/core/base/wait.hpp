// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>

namespace rodeira::base {

// While it lives, this thread waits for `cause` ("the road server's world"), a text that outlives it. The wait is that
// of the node which the thread works for (NodeCall). A node reports the longest of its waits to the clock; `rodeira ctl
// state` shows it.
class WaitNote {
 public:
  explicit WaitNote(const char* cause);
  ~WaitNote();
  WaitNote(const WaitNote&) = delete;
  WaitNote& operator=(const WaitNote&) = delete;

 private:
  friend std::string LongestWait(std::chrono::milliseconds at_least, std::string_view node);
  const char* cause_;
  const char* node_;  // null: none
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  WaitNote* older_ = nullptr;  // the list of this process, newest first
  WaitNote* newer_ = nullptr;
};

// "waits for the road server's world since 3.2 s": the longest wait of this node; empty if none lasts so long. `node`:
// empty in a process of one node. Any thread.
std::string LongestWait(std::chrono::milliseconds at_least, std::string_view node = {});

// Waits until `predicate` holds, or for `limit`. `cause`: as WaitNote's. A wait without end is none of these: it is
// named in tests/architecture/endless_waits.txt, with its reason.
// Returns what the predicate says at the end.
template <class Predicate>
bool WaitFor(std::condition_variable& changed, std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds limit,
             const char* cause, Predicate predicate) {
  const WaitNote note(cause);
  return changed.wait_for(lock, limit, predicate);
}

}  // namespace rodeira::base

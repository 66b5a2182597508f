// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace rodeira::dds {

// What the parent writes to standard input: "lost NODE TEXT", what it sees sooner than any heartbeat, a process of its
// own that died or was stopped; and "do NUMBER COMMAND", what the operator asks for.
class ParentsWord {
 public:
  // Once. The thread ends with the process; `this` must live as long.
  void Listen(std::function<void()> on_word) {
    std::thread([this, on_word = std::move(on_word)] {
      char line[4096];
      while (std::fgets(line, sizeof(line), stdin) != nullptr) {
        std::string text(line);
        while (!text.empty() && text.back() == '\n') text.pop_back();
        const bool asks = text.starts_with("do ");
        if (!asks && !text.starts_with("lost ")) continue;
        {
          const std::lock_guard lock(mutex_);
          if (asks) asked_.push_back(text.substr(3));
          if (!asks) lost_.push_back(text.substr(5));
        }
        on_word();
      }
    }).detach();
  }
  // "NODE TEXT", each once.
  std::vector<std::string> TakeLost() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lost_, {});
  }
  // "NUMBER COMMAND", each once.
  std::vector<std::string> TakeAsked() {
    const std::lock_guard lock(mutex_);
    return std::exchange(asked_, {});
  }
  // There is something that was not taken.
  bool is_waiting() const {
    const std::lock_guard lock(mutex_);
    return !lost_.empty() || !asked_.empty();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lost_;
  std::vector<std::string> asked_;
};

}  // namespace rodeira::dds

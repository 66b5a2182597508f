#pragma once

#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace rodeira::dds {

// The first line "fault TEXT" or "lost NODE TEXT" that the parent writes to standard input: what it sees sooner than any
// heartbeat, a process of its own that died or was stopped.
class ParentsWord {
 public:
  // Once. The thread ends with the process; `this` must live as long.
  void Listen(std::function<void()> on_word) {
    std::thread([this, on_word = std::move(on_word)] {
      char line[4096];
      while (std::fgets(line, sizeof(line), stdin) != nullptr) {
        std::string text(line);
        while (!text.empty() && text.back() == '\n') text.pop_back();
        if (!text.starts_with("fault ") && !text.starts_with("lost ")) continue;
        {
          const std::lock_guard lock(mutex_);
          if (word_.empty()) word_ = text;
        }
        on_word();
      }
    }).detach();
  }
  // Empty as long as there is none.
  std::string word() const {
    const std::lock_guard lock(mutex_);
    return word_;
  }

 private:
  mutable std::mutex mutex_;
  std::string word_;
};

}  // namespace rodeira::dds

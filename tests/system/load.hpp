// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <thread>
#include <vector>

namespace rodeira::system_test {

// Threads that do nothing but keep processors busy, as long as this lives.
class CpuLoad {
 public:
  explicit CpuLoad(unsigned threads) {
    for (unsigned i = 0; i < threads; ++i) {
      threads_.emplace_back([this] {
        while (busy_.load(std::memory_order_relaxed)) {
        }
      });
    }
  }
  ~CpuLoad() {
    busy_ = false;
    for (std::thread& thread : threads_) thread.join();
  }
  CpuLoad(const CpuLoad&) = delete;
  CpuLoad& operator=(const CpuLoad&) = delete;

 private:
  std::atomic<bool> busy_ = true;
  std::vector<std::thread> threads_;
};

}  // namespace rodeira::system_test

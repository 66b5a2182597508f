// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <thread>

namespace rodeira::record {

// Brings an open file to the disk on a thread of its own, so that its writer never waits for the disk: what a loss of
// power takes is what was written since the last one that has returned.
class BackgroundSync {
 public:
  // The descriptor stays open as long as this lives. The file's name is brought to the disk first.
  BackgroundSync(int file, std::filesystem::path path);
  BackgroundSync(const BackgroundSync&) = delete;
  BackgroundSync& operator=(const BackgroundSync&) = delete;

  // Asks for one more sync; one that is asked for while another waits is the same. Never waits for the disk.
  void Request();
  // errno of the first sync that failed; 0: none has.
  int error() const { return error_; }

 private:
  void Work(const std::stop_token& done, int file, const std::filesystem::path& path);

  std::mutex mutex_;
  std::condition_variable_any requested_;
  bool is_requested_ = false;
  std::atomic<int> error_ = 0;
  std::jthread thread_;
};

}  // namespace rodeira::record

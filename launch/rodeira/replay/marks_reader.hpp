// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <future>
#include <optional>
#include <vector>

#include "common/core/base/result.hpp"
#include "nodes/view/playback/replay_window.hpp"

namespace rodeira::cli {

// Reads a recording's marks (MarksOf) beside the window that shows it, by a thread and a reader of its own: of an hour
// with a scenario all chunks are read.
class MarksReader {
 public:
  explicit MarksReader(const std::filesystem::path& file);
  ~MarksReader();  // what is not yet read is given up
  MarksReader(const MarksReader&) = delete;
  MarksReader& operator=(const MarksReader&) = delete;

  // All of them, or why they cannot be read: once, when that is known.
  std::optional<base::Result<std::vector<nodes::ReplayMark>>> Take();

 private:
  std::atomic<bool> stop_ = false;
  std::future<base::Result<std::vector<nodes::ReplayMark>>> marks_;
};

}  // namespace rodeira::cli

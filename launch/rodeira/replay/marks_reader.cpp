// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/marks_reader.hpp"

#include <chrono>

#include "launch/rodeira/replay/recorded_view.hpp"

namespace rodeira::cli {

MarksReader::MarksReader(const std::filesystem::path& file)
    : marks_(std::async(std::launch::async, [this, file]() -> base::Result<std::vector<nodes::ReplayMark>> {
        const auto run = replay::RecordedRun::Open(file);
        if (!run) return run.error();
        return MarksOf(run.value(), [this] { return stop_.load(); });
      })) {}

MarksReader::~MarksReader() { stop_ = true; }

std::optional<base::Result<std::vector<nodes::ReplayMark>>> MarksReader::Take() {
  if (!marks_.valid() || marks_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  return marks_.get();
}

}  // namespace rodeira::cli

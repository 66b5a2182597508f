// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/export_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "common/core/base/print_error.hpp"
#include "common/data/csv/export.hpp"
#include "idl/aliases.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/replay/recording_text.hpp"

namespace rodeira::cli {
namespace {

// What is done, on a terminal and after two seconds.
class ExportProgress {
 public:
  explicit ExportProgress(bool quiet) : quiet_(quiet || ::isatty(STDERR_FILENO) == 0) {}
  ~ExportProgress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  bool Show(double share) {
    if (!quiet_ && std::chrono::steady_clock::now() - start_ > std::chrono::seconds(2)) {
      fmt::print(stderr, "\r\033[K{:.0f} % written", 100.0 * share);
      shown_ = true;
    }
    return !Interrupted();
  }

 private:
  bool quiet_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

csv::Selection SelectionOf(const ExportOptions& options) {
  csv::Selection selection;
  selection.topics = SplitAtCommas(options.topics);
  selection.columns = SplitAtCommas(options.columns);
  selection.rate_hz = options.rate_hz;
  for (const std::string_view topic :
       {idl::topics::kScenarioEvents, idl::topics::kCollisions, idl::topics::kRemarks, idl::topics::kWallTime}) {
    selection.events.emplace(topic);
  }
  selection.from_s = options.from_s;
  selection.to_s = options.to_s;
  return selection;
}

}  // namespace

int Export(const ExportOptions& options) {
  CatchInterrupts();
  const auto reader = record::McapReader::Open(options.recording);
  const auto report = [&]() -> base::Result<csv::ExportReport> {
    if (!reader) return reader.error();
    ExportProgress progress(options.quiet);
    return csv::ExportCsv(
        reader.value(), options.csv, idl::Aliases(), [&progress](double share) { return progress.Show(share); },
        SelectionOf(options));
  }();
  if (!report) return base::PrintError("rodeira", report.error());
  if (!options.quiet) {
    constexpr const char* kLine = "{:<24}  {:<24}  {:>9}  {:>9}  {:>10}\n";
    fmt::print(kLine, "table", "topic", "samples", "rows", "size");
    for (const auto& table : report.value().tables) {
      fmt::print(kLine, table.file, table.topic, table.messages, table.rows, Size(table.bytes));
    }
    for (const std::string& sentence : report.value().left_out) fmt::print("left out  {}\n", sentence);
  }
  for (const std::string& loss : report.value().losses)
    base::PrintError("rodeira", base::Failed("recording.damaged", loss, options.recording));
  const bool whole = report.value().losses.empty() && reader.value().condition().whole;
  if (whole) return 0;
  return base::PrintError(
      "rodeira", base::Failed("recording.damaged", fmt::format("{} is not whole: the tables in {} hold what could be "
                                                               "read",
                                                               options.recording, options.csv)));
}

}  // namespace rodeira::cli

// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/report_command.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "common/analysis/report/page.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"
#include "launch/rodeira/interrupt.hpp"

namespace rodeira::cli {
namespace {

base::Status WriteReport(const ReportOptions& options) {
  const std::string extension = std::filesystem::path(options.out).extension().string();
  if (extension != ".html" && extension != ".htm")
    return base::WrongInput("command.wrong_value", "a report is written as .html", "-o " + options.out);
  const auto spec = MeasuresSpecOf(options.spec, options.intervals, options.baseline, options.subject);
  if (!spec) return spec.error();
  ReadingProgress progress(options.quiet, options.recordings.size());
  std::vector<MeasuredRecording> recordings;
  std::vector<measures::MeasuresRow> rows;
  std::vector<std::vector<measures::MeasuresRow>> rows_of;
  for (std::size_t i = 0; i < options.recordings.size(); ++i) {
    auto recording = ReadMeasured(options.recordings[i], spec.value().subject,
                                  [&](double share) { return progress.Show(i, share); });
    if (!recording) return recording.error();
    recordings.push_back(std::move(recording).value());
    rows_of.push_back(RowsOf(spec.value(), recordings.back()));
    rows.insert(rows.end(), rows_of.back().begin(), rows_of.back().end());
  }
  if (auto status = CheckIntervalNames(spec.value(), rows); !status) return status;
  std::vector<report::ReportedDrive> drives;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const MeasuredRecording& recording = recordings[i];
    report::ReportedDrive drive;
    drive.reading = &recording.reading;
    drive.network = recording.world == nullptr ? nullptr : recording.world->network();
    drive.facts = recording.facts;
    drive.meta.assign(recording.meta.begin(), recording.meta.end());
    drive.rows = std::move(rows_of[i]);
    drives.push_back(std::move(drive));
  }
  return base::WriteWhole(options.out, std::string_view(report::ReportPage(spec.value(), drives)));
}

}  // namespace

int Report(const ReportOptions& options) {
  CatchInterrupts();
  if (auto status = WriteReport(options); !status) return base::PrintError("rodeira report", status.error());
  if (!options.quiet) fmt::print("wrote {}\n", options.out);
  return 0;
}

}  // namespace rodeira::cli

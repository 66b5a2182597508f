// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/measures_command.hpp"

#include <fmt/format.h>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/data/csv/csv_file.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"
#include "launch/rodeira/interrupt.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

base::Status WriteSeries(const measures::Drive& drive, const std::string& file) {
  auto out = csv::CsvFile::Create(file);
  if (!out) return out.error();
  out.value().buffer() += measures::SeriesHeader();
  for (std::size_t k = 0; k < drive.size(); ++k) {
    measures::AppendSeriesRow(drive, k, out.value().buffer());
    if (auto status = out.value().Drain(); !status) return status;
  }
  return out.value().Close();
}

fs::path SidecarOf(const std::string& table) { return fs::path(table).replace_extension(".measures.yaml"); }

base::Status CheckOptions(const MeasuresOptions& options) {
  const std::string extension = fs::path(options.out).extension().string();
  if (!options.out.empty() && extension != ".csv" && extension != ".json")
    return base::WrongInput("command.wrong_value", "a table is written as .csv or .json", "-o " + options.out);
  std::error_code none;
  if (!options.out.empty() && !options.spec.empty() && fs::equivalent(SidecarOf(options.out), options.spec, none))
    return base::WrongInput("command.wrong_value",
                            "the options beside this table would replace the measures file; another name was expected",
                            "-o " + options.out);
  if (options.long_format && extension == ".json")
    return base::WrongInput("command.wrong_value", "a long table is written as .csv", "-o " + options.out);
  if (!options.series.empty() && options.recordings.size() != 1)
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("the time series of one recording are written; {} recordings are named", options.recordings.size()),
        "--series " + options.series);
  return {};
}

base::Status WriteTable(const MeasuresOptions& options, const measures::MeasuresSpec& spec,
                        const std::vector<measures::MeasuresRow>& rows,
                        const std::vector<measures::RecordingFacts>& facts) {
  if (options.out.empty()) {
    fmt::print("{}", options.long_format ? measures::LongCsvTable(spec, rows) : measures::TextTable(spec, rows));
    return {};
  }
  const fs::path out(options.out);
  const std::string table = out.extension() == ".json" ? measures::JsonTable(spec, rows)
                            : options.long_format      ? measures::LongCsvTable(spec, rows)
                                                       : measures::CsvTable(spec, rows);
  if (auto status = base::WriteWhole(out, std::string_view(table)); !status) return status;
  return base::WriteWhole(SidecarOf(options.out), std::string_view(measures::SidecarText(spec, rows, facts)));
}

}  // namespace

int Measures(const MeasuresOptions& options) {
  CatchInterrupts();
  if (options.list) {
    fmt::print("{}", measures::ListText());
    return 0;
  }
  if (!options.explain.empty()) {
    const auto info = measures::FindMeasure(options.explain);
    if (!info) return base::PrintError("rodeira measures", info.error());
    fmt::print("{}", measures::ExplainText(*info.value()));
    return 0;
  }
  if (options.recordings.empty())
    return base::PrintError(
        "rodeira measures",
        base::WrongInput("command.missing_argument",
                         "no recording is named; FILE.mcap, --list or --explain NAME was expected"));
  if (auto status = CheckOptions(options); !status) return base::PrintError("rodeira measures", status.error());
  const auto spec = MeasuresSpecOf(options.spec, options.intervals, options.baseline, options.subject);
  if (!spec) return base::PrintError("rodeira measures", spec.error());
  ReadingProgress progress(options.quiet, options.recordings.size());
  std::vector<measures::MeasuresRow> rows;
  std::vector<measures::RecordingFacts> facts;
  for (std::size_t i = 0; i < options.recordings.size(); ++i) {
    const auto measured = ReadMeasured(options.recordings[i], spec.value().subject,
                                       [&](double share) { return progress.Show(i, share); });
    if (!measured) return base::PrintError("rodeira measures", measured.error());
    const MeasuredRecording& m = measured.value();
    if (!options.series.empty()) {
      if (auto status = WriteSeries(m.reading.drive, options.series); !status)
        return base::PrintError("rodeira measures", status.error());
    }
    for (measures::MeasuresRow& row : RowsOf(spec.value(), m)) rows.push_back(std::move(row));
    facts.push_back(m.facts);
  }
  if (auto status = CheckIntervalNames(spec.value(), rows); !status)
    return base::PrintError("rodeira measures", status.error());
  if (auto status = WriteTable(options, spec.value(), rows, facts); !status)
    return base::PrintError("rodeira measures", status.error());
  if (options.quiet || options.out.empty()) return 0;
  fmt::print("wrote {} and {}\n", options.out, SidecarOf(options.out).string());
  for (const measures::MeasuresRow& row : rows) {  // of empty cells
    if (!row.interval.reason.empty())
      fmt::print(stderr, "rodeira: warning: {}: interval '{}': {}\n", row.file, row.interval.name, row.interval.reason);
  }
  return 0;
}

}  // namespace rodeira::cli

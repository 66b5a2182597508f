// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/export_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/analysis/floating_cars/write_floating_cars.hpp"
#include "common/analysis/measures/intervals.hpp"
#include "common/analysis/measures/series.hpp"
#include "common/core/base/print_error.hpp"
#include "common/data/csv/export.hpp"
#include "idl/aliases.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"
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

// The time in seconds of a mark or event of the recording. Wrong input where it has none of that name.
base::Result<double> TimeOfPoint(const measures::TimePoint& point, const record::McapReader& reader,
                                 const char* option) {
  const auto events = measures::ReadEvents(reader, idl::Aliases());
  if (!events) return events.error();
  measures::IntervalSpec spec;
  spec.from = point;
  spec.for_s = 1.0;
  const auto interval = measures::FindInterval(spec, events.value(), std::numeric_limits<double>::infinity());
  if (!interval.reason.empty()) return base::WrongInput("measure.wrong_interval", interval.reason, option);
  return interval.from_s;
}

// Nothing where the point does not restrict: the start, the end.
base::Result<std::optional<double>> SecondsOf(const std::string& text, const record::McapReader& reader,
                                              const char* option) {
  if (text.empty()) return std::optional<double>();
  const auto point = measures::ParseTimePoint(text);
  if (!point) return point.error().In(option);
  switch (point.value().kind) {
    case measures::TimePoint::Kind::kStart:
    case measures::TimePoint::Kind::kEnd:
      return std::optional<double>();
    case measures::TimePoint::Kind::kSeconds:
      return std::optional(point.value().seconds);
    default:
      break;
  }
  const auto seconds = TimeOfPoint(point.value(), reader, option);
  if (!seconds) return seconds.error();
  return std::optional(seconds.value());
}

base::Status SetTimes(const ExportOptions& options, const record::McapReader& reader, csv::Selection& selection) {
  const auto from = SecondsOf(options.from, reader, "--from");
  if (!from) return from.error();
  selection.from_s = from.value();
  const bool duration = options.to.starts_with('+');
  const auto to = SecondsOf(duration ? options.to.substr(1) : options.to, reader, "--to");
  if (!to) return to.error();
  selection.to_s = to.value();
  if (duration && to.value()) selection.to_s = *to.value() + from.value().value_or(0.0);
  return {};
}

base::Result<csv::Selection> SelectionOf(const ExportOptions& options, const record::McapReader& reader) {
  csv::Selection selection;
  selection.topics = SplitAtCommas(options.topics);
  selection.columns = SplitAtCommas(options.columns);
  selection.rate_hz = options.rate_hz;
  for (const std::string_view topic :
       {idl::topics::kScenarioEvents, idl::topics::kCollisions, idl::topics::kRemarks, idl::topics::kWallTime}) {
    selection.events.emplace(topic);
  }
  if (auto status = SetTimes(options, reader, selection); !status) return status.error();
  return selection;
}

base::Result<csv::PlainTable> MarksTable(const record::McapReader& reader, const csv::Selection& selection) {
  const auto events = measures::ReadEvents(reader, idl::Aliases());
  if (!events) return events.error();
  std::vector<double> times;
  csv::TextColumn kinds, names, arguments;
  for (const measures::DriveEvent& event : events.value()) {
    if (!csv::Holds(selection, event.time_s)) continue;
    times.push_back(event.time_s);
    kinds.Add(event.kind == measures::DriveEvent::Kind::kMark ? "mark" : "event");
    names.Add(event.name);
    arguments.Add(event.argument);
  }
  return csv::PlainTable{"marks",
                         {{"time_s", std::move(times)},
                          {"kind", std::move(kinds)},
                          {"name", std::move(names)},
                          {"argument", std::move(arguments)}}};
}

base::Result<csv::PlainTable> DerivedTable(const ExportOptions& options, const csv::Selection& selection,
                                           const std::function<bool(double)>& progress) {
  const auto measured = ReadMeasured(options.recording, options.subject, progress);
  if (!measured) return measured.error();
  const measures::Drive& drive = measured.value().reading.drive;
  std::vector<std::size_t> samples;
  csv::Thinning thinning(options.rate_hz > 0.0 ? options.rate_hz : drive.rate_hz);
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const double time_s = static_cast<double>(k) / drive.rate_hz;
    if (csv::Holds(selection, time_s) && thinning.Keeps(static_cast<std::uint64_t>(std::llround(time_s * 1e9))))
      samples.push_back(k);
  }
  csv::PlainTable table{"derived", {}};
  for (std::size_t column = 0; column < measures::SeriesNames().size(); ++column) {
    std::vector<double> values;
    values.reserve(samples.size());
    for (const std::size_t k : samples) values.push_back(measures::SeriesValue(drive, column, k));
    table.columns.push_back({measures::SeriesNames()[column], std::move(values)});
  }
  return table;
}

base::Result<csv::ExportReport> WriteTables(const ExportOptions& options, const record::McapReader& reader) {
  using Form = csv::ExportTarget::Form;
  if (options.csv.empty() == options.mat.empty())
    return base::WrongInput("command.missing_argument", "--csv DIR, --mat FILE.mat or --fcd FILE.xml was expected");
  const Form form = !options.mat.empty() ? Form::kMat : options.long_format ? Form::kLong : Form::kWide;
  const csv::ExportTarget target{form, form == Form::kMat ? options.mat : options.csv};
  const auto selection = SelectionOf(options, reader);
  if (!selection) return selection.error();
  ExportProgress progress(options.quiet);
  const auto show = [&progress](double share) { return progress.Show(share); };
  std::vector<csv::PlainTable> more;
  if (options.marks) {
    auto marks = MarksTable(reader, selection.value());
    if (!marks) return marks.error();
    more.push_back(std::move(marks).value());
  }
  if (options.derived) {
    auto derived = DerivedTable(options, selection.value(), show);
    if (!derived) return derived.error();
    more.push_back(std::move(derived).value());
  }
  return csv::ExportTables(reader, target, idl::Aliases(), show, selection.value(), more);
}

base::Result<floating_cars::FloatingCarsReport> WriteFcd(const ExportOptions& options) {
  const auto run = replay::RecordedRun::Open(options.recording);
  if (!run) return run.error();
  const auto world = EmbeddedWorld(run.value());
  if (!world) return world.error();
  auto selection = SelectionOf(options, run.value().reader());
  if (!selection) return selection.error();
  ExportProgress progress(options.quiet);
  floating_cars::FloatingCarsQuery query;
  query.aliases = &idl::Aliases();
  query.network = world.value() == nullptr ? nullptr : world.value()->network();
  query.selection = std::move(selection).value();
  query.progress = [&progress](double share) { return progress.Show(share); };
  auto report = floating_cars::WriteFloatingCars(run.value().reader(), options.fcd, query);
  if (!report && report.error().context.empty()) return report.error().In(options.recording);
  return report;
}

int ExportFcd(const ExportOptions& options) {
  const auto report = WriteFcd(options);
  if (!report) return base::PrintError("rodeira", report.error());
  const floating_cars::FloatingCarsReport& r = report.value();
  if (!options.quiet)
    fmt::print("{}  {} timesteps of {:g} s, {} vehicles, {} persons, {}\n", options.fcd, r.timesteps, r.period_s,
               r.vehicles, r.persons, Size(r.bytes));
  return 0;
}

}  // namespace

int Export(const ExportOptions& options) {
  CatchInterrupts();
  if (!options.fcd.empty()) return ExportFcd(options);
  const auto reader = record::McapReader::Open(options.recording);
  const auto report = reader ? WriteTables(options, reader.value()) : reader.error();
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
      "rodeira", base::Failed("recording.damaged",
                              fmt::format("{} is not whole: the tables in {} hold what could be "
                                          "read",
                                          options.recording, options.mat.empty() ? options.csv : options.mat)));
}

}  // namespace rodeira::cli

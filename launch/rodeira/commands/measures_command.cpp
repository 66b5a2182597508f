// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/measures_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common/analysis/measures/table.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/data/csv/csv_file.hpp"
#include "common/runtime/replay/recorded_run.hpp"
#include "common/world/road/world.hpp"
#include "idl/aliases.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/replay/content_digest.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

// On a terminal, and after two seconds.
class MeasuresProgress {
 public:
  MeasuresProgress(bool quiet, std::size_t files) : quiet_(quiet || ::isatty(STDERR_FILENO) == 0), files_(files) {}
  ~MeasuresProgress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  bool Show(std::size_t file, double share) {
    if (!quiet_ && std::chrono::steady_clock::now() - start_ > std::chrono::seconds(2)) {
      const double done = (static_cast<double>(file) + share) / static_cast<double>(files_);
      fmt::print(stderr, "\r\033[K{:.0f} % read", 100.0 * done);
      shown_ = true;
    }
    return !Interrupted();
  }

 private:
  bool quiet_;
  std::size_t files_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A recording that was read.
struct MeasuredRecording {
  measures::DriveReading reading;
  measures::RecordingFacts facts;
  record::TextMap meta;
};

base::Result<MeasuredRecording> ReadRecording(const std::string& file, const std::string& subject,
                                              const std::function<bool(double)>& progress) {
  const auto run = replay::RecordedRun::Open(file);
  if (!run) return run.error();
  std::shared_ptr<const road::World> world;
  if (!run.value().launch().world().empty()) {
    auto loaded = road::World::Load(run.value().launch().world());
    if (!loaded) return run.value().Named(loaded.error());
    world = std::move(loaded).value();
    const std::string hash = base::Hex(world->content_hash());
    if (!run.value().world_hash().empty() && run.value().world_hash() != hash) {
      return base::WrongInput("replay.other_world",
                              fmt::format("the recording says world_hash {}, the embedded world has {}; lanes cannot "
                                          "be found with another world",
                                          run.value().world_hash(), hash),
                              file);
    }
  }
  ContentDigest content;
  measures::DriveQuery query;
  query.subject = subject;
  query.aliases = &idl::Aliases();
  query.on_message = [&content](const record::Channel& channel, const record::Message& message) {
    content.Add(channel, message);
  };
  query.progress = progress;
  auto reading = measures::ReadDrive(run.value().reader(), world == nullptr ? nullptr : world->network(), query);
  if (!reading) {
    return reading.error().In(file);
  }
  MeasuredRecording measured{std::move(reading).value(), {}, {}};
  measures::RecordingFacts& facts = measured.facts;
  facts.file = file;
  facts.subject = measured.reading.drive.subject;
  facts.version = run.value().version();
  facts.commit = run.value().commit();
  facts.world_hash = run.value().world_hash();
  facts.content = base::Hex(content.digest());
  facts.notes = measured.reading.drive.notes;
  const auto meta = run.value().reader().FindMetadata("rodeira.meta");
  if (!meta) return meta.error();
  if (meta.value()) measured.meta = meta.value()->entries;
  return measured;
}

std::string MetaOf(const record::TextMap& meta, const char* key) {
  const auto found = meta.find(key);
  return found == meta.end() ? std::string() : found->second;
}

base::Result<measures::MeasuresSpec> SpecOf(const MeasuresOptions& options) {
  auto spec = options.spec.empty() ? base::Result(measures::DefaultSpec()) : measures::ReadSpec(options.spec);
  if (!spec) return spec;
  measures::MeasuresSpec& s = spec.value();
  if (!options.intervals.empty()) s.intervals.clear();
  std::vector<std::string> names;
  for (const std::string& text : options.intervals) {
    auto interval = measures::ParseInterval(text);
    if (!interval) return interval.error().In("--intervals");
    names.push_back(interval.value().name);
    if (std::ranges::count(names, names.back()) > 1)
      return base::WrongInput("measure.duplicate_interval", fmt::format("two intervals are named '{}'", names.back()),
                              "--intervals");
    s.intervals.push_back(std::move(interval).value());
  }
  if (!options.baseline.empty()) s.baseline = options.baseline;
  if (auto status = measures::CheckBaseline(s); !status)
    return status.error().WithContext(options.baseline.empty() ? "--intervals" : "--baseline");
  if (!options.subject.empty()) s.subject = options.subject;
  return spec;
}

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

// An interval by a mark or event that is in none of the recordings is a wrong name.
base::Status CheckNames(const measures::MeasuresSpec& spec, const std::vector<measures::MeasuresRow>& rows) {
  for (const measures::IntervalSpec& interval : spec.intervals) {
    const auto is_its = [&](const measures::MeasuresRow& row) { return row.interval.name == interval.name; };
    const auto known = [&](const measures::MeasuresRow& row) { return is_its(row) && !row.interval.unknown; };
    if (std::ranges::any_of(rows, known)) continue;
    const auto row = std::ranges::find_if(rows, is_its);
    if (row != rows.end())
      return base::WrongInput("measure.wrong_interval", row->interval.reason,
                              fmt::format("interval '{}'", interval.name));
  }
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
  const auto spec = SpecOf(options);
  if (!spec) return base::PrintError("rodeira measures", spec.error());
  MeasuresProgress progress(options.quiet, options.recordings.size());
  std::vector<measures::MeasuresRow> rows;
  std::vector<measures::RecordingFacts> facts;
  for (std::size_t i = 0; i < options.recordings.size(); ++i) {
    const auto measured = ReadRecording(options.recordings[i], spec.value().subject,
                                        [&](double share) { return progress.Show(i, share); });
    if (!measured) return base::PrintError("rodeira measures", measured.error());
    const MeasuredRecording& m = measured.value();
    if (!options.series.empty()) {
      if (auto status = WriteSeries(m.reading.drive, options.series); !status)
        return base::PrintError("rodeira measures", status.error());
    }
    for (measures::MeasuresRow& row : measures::ComputeRows(spec.value(), m.reading)) {
      row.file = options.recordings[i];
      row.participant = MetaOf(m.meta, "participant");
      row.condition = MetaOf(m.meta, "condition");
      row.run = MetaOf(m.meta, "run");
      rows.push_back(std::move(row));
    }
    facts.push_back(m.facts);
  }
  if (auto status = CheckNames(spec.value(), rows); !status)
    return base::PrintError("rodeira measures", status.error());
  if (auto status = WriteTable(options, spec.value(), rows, facts); !status)
    return base::PrintError("rodeira measures", status.error());
  return 0;
}

}  // namespace rodeira::cli

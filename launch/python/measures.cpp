// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "common/analysis/measures/given_drive.hpp"
#include "common/analysis/measures/series.hpp"
#include "launch/python/columns.hpp"
#include "launch/python/extension.hpp"
#include "launch/rodeira/commands/measured_recording.hpp"

namespace rodeira::python {
namespace {

namespace py = pybind11;
using Options = std::map<std::string, std::map<std::string, double>>;

// What Python asks for; texts and lists may be empty.
struct Question {
  std::string spec_file;
  std::vector<std::string> intervals;
  std::string baseline, subject;
  std::vector<std::string> measures;
  Options options;
};

Question QuestionOf(const py::dict& given) {
  return {given["spec"].cast<std::string>(),
          given["intervals"].cast<std::vector<std::string>>(),
          given["baseline"].cast<std::string>(),
          given["subject"].cast<std::string>(),
          given["measures"].cast<std::vector<std::string>>(),
          given["options"].cast<Options>()};
}

base::Result<measures::MeasuresSpec> SpecOf(const Question& question) {
  auto spec = cli::MeasuresSpecOf(question.spec_file, question.intervals, question.baseline, question.subject);
  if (!spec) return spec;
  if (!question.measures.empty()) spec.value().measures.clear();
  for (const std::string& name : question.measures) {
    const auto info = measures::FindMeasure(name);
    if (!info) return info.error();
    spec.value().measures.push_back(info.value());
  }
  for (const auto& [name, values] : question.options) {
    const auto info = measures::FindMeasure(name);
    if (!info) return info.error();
    for (const auto& [option, value] : values) {
      if (auto status = measures::SetOption(*info.value(), option, value, spec.value()); !status) return status.error();
    }
  }
  return spec;
}

py::list RowsOf(const measures::MeasuresSpec& spec, const std::vector<measures::MeasuresRow>& rows) {
  py::list all;
  for (const measures::MeasuresRow& row : rows) {
    py::list values;
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const measures::Measure& m = row.values[i];
      py::dict options;
      for (const measures::UsedOption& option : m.options) options[py::str(option.name)] = option.value;
      py::dict value;
      value["name"] = spec.measures[i]->name;
      value["value"] = m.value ? py::object(py::float_(*m.value)) : py::object(py::none());
      value["unit"] = m.unit;
      value["n"] = m.n;
      value["valid_share"] = m.valid_share;
      value["options"] = options;
      value["reason"] = m.reason;
      values.append(value);
    }
    py::dict entry;
    entry["file"] = row.file;
    entry["participant"] = row.participant;
    entry["condition"] = row.condition;
    entry["run"] = row.run;
    entry["interval"] = row.interval.name;
    entry["from_s"] = row.interval.from_s;
    entry["to_s"] = row.interval.to_s;
    entry["reason"] = row.interval.reason;
    entry["values"] = values;
    all.append(entry);
  }
  return all;
}

// Rows and notes of recordings. The lock of Python is released while a file is read.
py::tuple OfRecordings(const std::vector<std::string>& files, const py::dict& given) {
  const measures::MeasuresSpec spec = ValueOrRaise(SpecOf(QuestionOf(given)));
  std::vector<measures::MeasuresRow> rows;
  std::vector<std::string> notes;
  for (const std::string& file : files) {
    auto recording = [&] {
      const py::gil_scoped_release release;
      return cli::ReadMeasured(file, spec.subject, {});
    }();
    const cli::MeasuredRecording measured = ValueOrRaise(std::move(recording));
    for (measures::MeasuresRow& row : cli::RowsOf(spec, measured)) rows.push_back(std::move(row));
    notes.push_back(measured.facts.notes);
  }
  if (auto status = cli::CheckIntervalNames(spec, rows); !status) Raise(status.error());
  return py::make_tuple(RowsOf(spec, rows), notes);
}

measures::DriveReading ReadingOf(const py::dict& columns, double rate_hz, const py::dict& vehicle,
                                 const std::vector<std::tuple<double, std::string, std::string, bool>>& events) {
  measures::GivenDrive given;
  given.rate_hz = rate_hz;
  for (const auto& [name, values] : columns)
    given.columns.emplace(name.cast<std::string>(), VectorOf(values.cast<Numbers>()));
  given.length_m = vehicle["length_m"].cast<double>();
  given.front_m = vehicle["front_m"].cast<double>();
  given.width_m = vehicle["width_m"].cast<double>();
  measures::DriveReading reading;
  reading.drive = ValueOrRaise(measures::DriveOf(given));
  for (const auto& [time_s, name, argument, mark] : events) {
    const auto kind = mark ? measures::DriveEvent::Kind::kMark : measures::DriveEvent::Kind::kScenario;
    reading.events.push_back({kind, time_s, name, argument});
  }
  return reading;
}

py::list OfColumns(const py::dict& columns, double rate_hz, const py::dict& vehicle,
                   const std::vector<std::tuple<double, std::string, std::string, bool>>& events,
                   const py::dict& given) {
  const measures::MeasuresSpec spec = ValueOrRaise(SpecOf(QuestionOf(given)));
  const measures::DriveReading reading = ReadingOf(columns, rate_hz, vehicle, events);
  const std::vector<measures::MeasuresRow> rows = measures::ComputeRows(spec, reading);
  if (auto status = cli::CheckIntervalNames(spec, rows); !status) Raise(status.error());
  return RowsOf(spec, rows);
}

// The time series of a recording's road user, by column.
py::dict Series(const std::string& file, const std::string& subject) {
  auto recording = [&] {
    const py::gil_scoped_release release;
    return cli::ReadMeasured(file, subject, {});
  }();
  const cli::MeasuredRecording measured = ValueOrRaise(std::move(recording));
  py::dict columns;
  for (std::size_t column = 0; column < measures::SeriesNames().size(); ++column)
    columns[py::str(measures::SeriesNames()[column])] = ArrayOf(measures::SeriesOf(measured.reading.drive, column));
  return columns;
}

py::dict Catalogue() {
  py::dict all;
  for (const measures::MeasureInfo& info : measures::Catalogue()) all[py::str(info.name)] = info.definition;
  return all;
}

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names;
  for (const measures::DriveColumn& column : measures::DriveColumns()) names.emplace_back(column.name);
  return names;
}

}  // namespace

void AddMeasures(py::module_& module) {
  module.def("measures_of_recordings", OfRecordings);
  module.def("measures_of_columns", OfColumns);
  module.def("series", Series);
  module.def("catalogue", Catalogue);
  module.def("columns", ColumnNames);
}

}  // namespace rodeira::python

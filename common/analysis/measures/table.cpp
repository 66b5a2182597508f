// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/analysis/measures/series.hpp"
#include "common/core/base/csv_cell.hpp"
#include "common/core/base/json_text.hpp"

namespace rodeira::measures {
namespace {

constexpr const char* kRowHeader = "file,participant,condition,run,interval,from_s,to_s";

std::string NumberCell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }
std::string ValueCell(const Measure& measure) { return measure.value ? NumberCell(*measure.value) : std::string(); }

std::string RowCells(const MeasuresRow& row) {
  return fmt::format("{},{},{},{},{},{},{}", base::CsvCell(row.file), base::CsvCell(row.participant),
                     base::CsvCell(row.condition), base::CsvCell(row.run), base::CsvCell(row.interval.name),
                     NumberCell(row.interval.from_s), NumberCell(row.interval.to_s));
}

std::string OptionsText(const Measure& measure) {
  std::string text;
  for (const UsedOption& option : measure.options)
    text += fmt::format("{}{}={}", text.empty() ? "" : "; ", option.name, option.value);
  return text;
}

std::string JsonNumber(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

}  // namespace

std::string CsvTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows) {
  std::string text = kRowHeader;
  for (const MeasureInfo* info : spec.measures) text += fmt::format(",{}", info->name);
  text += '\n';
  for (const MeasuresRow& row : rows) {
    text += RowCells(row);
    for (const Measure& measure : row.values) text += ',' + ValueCell(measure);
    text += '\n';
  }
  return text;
}

std::string LongCsvTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows) {
  std::string text = fmt::format("{},measure,value,unit,n,valid_share,missing,options\n", kRowHeader);
  for (const MeasuresRow& row : rows) {
    const std::string cells = RowCells(row);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const Measure& m = row.values[i];
      text += fmt::format("{},{},{},{},{},{},{},{}\n", cells, spec.measures[i]->name, ValueCell(m), m.unit, m.n,
                          m.valid_share, base::CsvCell(m.reason), base::CsvCell(OptionsText(m)));
    }
  }
  return text;
}

std::string JsonTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows) {
  std::string text = "[";
  for (const MeasuresRow& row : rows) {
    text += fmt::format(
        "{}\n  {{\"file\": {}, \"participant\": {}, \"condition\": {}, \"run\": {}, \"interval\": {}, "
        "\"from_s\": {}, \"to_s\": {}, \"measures\": {{",
        text.size() > 1 ? "," : "", base::JsonText(row.file), base::JsonText(row.participant),
        base::JsonText(row.condition), base::JsonText(row.run), base::JsonText(row.interval.name),
        JsonNumber(row.interval.from_s), JsonNumber(row.interval.to_s));
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const Measure& m = row.values[i];
      text += fmt::format("{}\n    {}: {{\"value\": {}, \"unit\": {}, \"n\": {}, \"valid_share\": {}",
                          i == 0 ? "" : ",", base::JsonText(spec.measures[i]->name),
                          JsonNumber(m.value.value_or(kMissing)), base::JsonText(m.unit), m.n, m.valid_share);
      if (!m.reason.empty()) text += fmt::format(", \"missing\": {}", base::JsonText(m.reason));
      text += ", \"options\": {";
      for (std::size_t o = 0; o < m.options.size(); ++o)
        text += fmt::format("{}{}: {}", o == 0 ? "" : ", ", base::JsonText(m.options[o].name),
                            base::JsonText(m.options[o].value));
      text += "}}";
    }
    text += "}}";
  }
  return text + "\n]\n";
}

std::string TextTable(const MeasuresSpec& spec, std::span<const MeasuresRow> rows) {
  std::string text;
  for (const MeasuresRow& row : rows) {
    text += fmt::format("{}{}  {}", text.empty() ? "" : "\n", row.file, row.interval.name);
    if (!row.interval.reason.empty()) {
      text += fmt::format("  missing: {}\n", row.interval.reason);
      continue;
    }
    text += fmt::format("  {:g} s to {:g} s\n", row.interval.from_s, row.interval.to_s);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const Measure& m = row.values[i];
      const std::string value = m.value ? fmt::format("{:>12.6g}  {}", *m.value, m.unit == "1" ? "" : m.unit)
                                        : fmt::format("{:>12}  {}", "-", m.reason);
      text += fmt::format("  {:<30}  {}\n", spec.measures[i]->name, value);
    }
  }
  return text;
}

std::string SeriesHeader() { return fmt::format("{}\n", fmt::join(SeriesNames(), ",")); }

void AppendSeriesRow(const Drive& drive, std::size_t k, std::string& out) {
  for (std::size_t column = 0; column < SeriesNames().size(); ++column) {
    if (column > 0) out += ',';
    out += NumberCell(SeriesValue(drive, column, k));
  }
  out += '\n';
}

}  // namespace rodeira::measures

// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/analysis/report/html.hpp"
#include "common/analysis/report/map_figure.hpp"
#include "common/analysis/report/strips.hpp"
#include "common/core/base/version.hpp"

namespace rodeira::report {
namespace {

// Without scripts; the policy forbids the browser to load anything.
constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{}</title>
<style>
body {{ font-family: sans-serif; font-size: 14px; color: #222; max-width: 1320px; margin: 24px auto; padding: 0 16px; }}
h1 {{ font-size: 24px; }} h2 {{ font-size: 18px; margin-top: 32px; }} h3 {{ font-size: 15px; }}
h2, h3 {{ break-after: avoid; }}
table {{ border-collapse: collapse; margin-bottom: 16px; }}
th, td {{ padding: 3px 10px; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top; }}
td.number {{ text-align: right; font-variant-numeric: tabular-nums; }}
td.missing {{ text-align: right; color: #777; }} ol.reasons {{ color: #555; font-size: 12px; }}
svg {{ max-width: 100%; height: auto; }}
div.wide {{ overflow-x: auto; }}
@media print {{
  body {{ margin: 0; max-width: none; font-size: 11px; }}
  tr, svg.map {{ break-inside: avoid; }}
  div.wide {{ overflow: visible; }}
}}
</style>
</head>
<body>
)";

std::string FactRow(const char* name, std::span<const std::string> values) {
  std::string row = fmt::format("<tr><th>{}</th>", name);
  for (const std::string& value : values) row += "<td>" + Html(value) + "</td>";
  return row + "</tr>\n";
}

// What a sheet of paper has room for.
constexpr std::size_t kRecordingsBeside = 4, kIntervalsBeside = 6;

template <class T, class MakeTable>
std::string TablesOf(std::span<const T> columns, std::size_t beside, const MakeTable& table) {
  std::string text;
  for (std::size_t from = 0; from < columns.size(); from += beside)
    text += table(columns.subspan(from, std::min(beside, columns.size() - from)));
  return text;
}

std::string FactsTable(std::span<const ReportedDrive> drives) {
  std::string table = "<div class=\"wide\"><table>\n";
  const auto row = [&](const char* name, const auto& value) {
    std::vector<std::string> values;
    bool any = false;
    for (const ReportedDrive& drive : drives) {
      values.push_back(value(drive));
      any = any || !values.back().empty();
    }
    if (any) table += FactRow(name, values);
  };
  row("file", [](const ReportedDrive& d) { return d.facts.file; });
  row("meta", [](const ReportedDrive& d) {
    std::string text;
    for (const auto& [key, value] : d.meta) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
    return text;
  });
  row("road user", [](const ReportedDrive& d) { return d.facts.subject; });
  row("duration", [](const ReportedDrive& d) {
    const measures::Drive& drive = d.reading->drive;
    return fmt::format("{:.2f} s", static_cast<double>(drive.size()) / drive.rate_hz);
  });
  row("recorded by", [](const ReportedDrive& d) { return d.facts.version + " " + d.facts.commit; });
  row("world", [](const ReportedDrive& d) { return d.facts.world_hash; });
  row("content", [](const ReportedDrive& d) { return d.facts.content; });
  row("notes", [](const ReportedDrive& d) { return d.facts.notes; });
  return table + "</table></div>\n";
}

std::string EventList(std::span<const ReportedDrive> drives) {
  std::string text;
  for (const ReportedDrive& drive : drives) {
    if (drive.reading->events.empty()) continue;
    text += fmt::format("<h3>{}</h3>\n<table>\n<thead>\n<tr><th>time</th><th>kind</th><th>name</th></tr>\n</thead>\n",
                        Html(ShortName(drive)));
    for (const measures::DriveEvent& event : drive.reading->events) {
      const char* kind = event.kind == measures::DriveEvent::Kind::kMark ? "mark" : "event";
      text += fmt::format("<tr><td class=\"number\">{:.3f} s</td><td>{}</td><td>{} {}</td></tr>\n", event.time_s, kind,
                          Html(event.name), Html(event.argument));
    }
    text += "</table>\n";
  }
  return text.empty() ? text : "<h2>Marks and events</h2>\n" + text;
}

// Why values are missing: numbered notes below the tables, since a sentence in a cell makes a printed column too wide.
class Reasons {
 public:
  // The number of a reason, from 1.
  std::size_t NumberOf(const std::string& reason) {
    const auto at = std::ranges::find(reasons_, reason);
    if (at == reasons_.end()) {
      reasons_.push_back(reason);
      return reasons_.size();
    }
    return static_cast<std::size_t>(at - reasons_.begin()) + 1;
  }
  std::string List() const {
    if (reasons_.empty()) return {};
    std::string text = "<p>Missing values:</p>\n<ol class=\"reasons\">\n";
    for (const std::string& reason : reasons_) text += fmt::format("<li>{}</li>\n", Html(reason));
    return text + "</ol>\n";
  }

 private:
  std::vector<std::string> reasons_;
};

// An interval of a recording.
struct IntervalColumn {
  std::string recording;
  const measures::MeasuresRow* row;
};

std::string MeasuresTable(const measures::MeasuresSpec& spec, std::span<const IntervalColumn> columns,
                          Reasons& reasons) {
  std::string text = "<div class=\"wide\"><table>\n<thead>\n<tr><th>measure</th><th>unit</th>";
  for (const auto& [recording, row] : columns) {
    text += fmt::format("<th>{}<br>{}", Html(recording), Html(row->interval.name));
    if (row->interval.reason.empty())
      text += fmt::format("<br>{:g} to {:g} s", row->interval.from_s, row->interval.to_s);
    text += "</th>";
  }
  text += "</tr>\n</thead>\n";
  for (std::size_t i = 0; i < spec.measures.size(); ++i) {
    const measures::MeasureInfo& info = *spec.measures[i];
    std::string unit, cells;
    for (const IntervalColumn& column : columns) {
      const measures::Measure& m = column.row->values[i];
      if (unit.empty()) unit = m.unit;
      cells += m.value ? fmt::format("<td class=\"number\">{:.5g}</td>", *m.value)
                       : fmt::format("<td class=\"missing\" title=\"{}\">– <sup>{}</sup></td>", Html(m.reason),
                                     reasons.NumberOf(m.reason));
    }
    text += fmt::format("<tr><th title=\"{}\">{}</th><td>{}</td>{}</tr>\n", Html(info.definition), Html(info.name),
                        unit == "1" ? "" : Html(unit), cells);
  }
  return text + "</table></div>\n";
}

std::string MeasuresTables(const measures::MeasuresSpec& spec, std::span<const ReportedDrive> drives) {
  std::vector<IntervalColumn> columns;
  for (const ReportedDrive& drive : drives) {
    for (const measures::MeasuresRow& row : drive.rows) columns.push_back({ShortName(drive), &row});
  }
  Reasons reasons;
  const auto table = [&](std::span<const IntervalColumn> some) { return MeasuresTable(spec, some, reasons); };
  const std::string tables = TablesOf(std::span<const IntervalColumn>(columns), kIntervalsBeside, table);
  return "<h2>Measures</h2>\n" + tables + reasons.List();
}

}  // namespace

std::string ReportPage(const measures::MeasuresSpec& spec, std::span<const ReportedDrive> drives) {
  const std::string title = drives.size() == 1 ? ShortName(drives[0]) : fmt::format("{} recordings", drives.size());
  std::string page = fmt::format(fmt::runtime(kHead), Html(title));
  page += fmt::format("<h1>{}</h1>\n", Html(title));
  page += "<h2>Recordings</h2>\n" + TablesOf(drives, kRecordingsBeside, FactsTable);
  for (const ReportedDrive& drive : drives) {
    const std::string map = MapSvg(drive.reading->drive, drive.network);
    if (!map.empty()) page += fmt::format("<h2>Way of {}</h2>\n", Html(ShortName(drive))) + map;
  }
  page += "<h2>Time series</h2>\n" + StripsSvg(drives);
  page += "<h2>Shares of time</h2>\n" + DistributionsSvg(drives);
  page += EventList(drives) + MeasuresTables(spec, drives);
  page += fmt::format("<p>Made by rodeira {}. A missing value has the number of its reason.</p>\n</body>\n</html>\n",
                      Html(base::Version()));
  return page;
}

}  // namespace rodeira::report

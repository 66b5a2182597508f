// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/report/page.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <regex>

#include "common/analysis/report/html.hpp"
#include "common/analysis/report/map_figure.hpp"
#include "common/analysis/report/strips.hpp"

namespace rodeira::report {
namespace {

using measures::kMissing;
using ::testing::HasSubstr;
using ::testing::Not;

// 10 s along a straight line at 20 m/s, with a second without samples.
measures::DriveReading StraightDrive() {
  measures::DriveReading reading;
  measures::Drive& d = reading.drive;
  d.subject = "ego";
  const std::size_t n = 1000;
  measures::GrowColumns(d, n);
  for (std::size_t k = 0; k < n; ++k) {
    if (k >= 500 && k < 600) continue;
    d.x_m[k] = 0.2 * static_cast<double>(k);
    d.y_m[k] = d.z_m[k] = d.heading_rad[k] = d.yaw_radps[k] = 0.0;
    d.speed_mps[k] = 20.0;
    d.throttle[k] = 0.25;
  }
  return reading;
}

measures::MeasuresSpec Spec() {
  measures::MeasuresSpec spec;
  for (const char* name : {"speed_max_mps", "sdlp_m"}) spec.measures.push_back(measures::FindMeasure(name).value());
  return spec;
}

ReportedDrive Reported(const measures::DriveReading& reading, const std::string& file) {
  ReportedDrive drive;
  drive.reading = &reading;
  drive.facts.file = file;
  drive.rows = measures::ComputeRows(Spec(), reading);
  return drive;
}

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

TEST(ReportPage, ShowsFactsMeasuresWithUnitsAndReasons) {
  const auto reading = StraightDrive();
  const ReportedDrive drive = Reported(reading, "drives/P07.mcap");
  const std::string page = ReportPage(Spec(), {&drive, 1});
  EXPECT_THAT(page, HasSubstr("<title>P07</title>"));
  EXPECT_THAT(page, HasSubstr("drives/P07.mcap"));
  EXPECT_THAT(page, HasSubstr("10.00 s"));
  EXPECT_THAT(page, HasSubstr(">speed_max_mps</th><td>m/s</td><td class=\"number\">20</td>"));
  const auto sdlp = drive.rows[0].values[1];
  ASSERT_FALSE(sdlp.value);
  EXPECT_THAT(page, HasSubstr("<td class=\"missing\" title=\"" + Html(sdlp.reason) + "\">– <sup>1</sup></td>"));
  EXPECT_THAT(page, HasSubstr("<ol class=\"reasons\">\n<li>" + Html(sdlp.reason) + "</li>\n</ol>"));
  EXPECT_EQ(page, ReportPage(Spec(), {&drive, 1})) << "the same bytes each time";
}

// Nothing of the page comes from elsewhere, and nothing in it runs.
TEST(ReportPage, NeedsNoNetworkAndHasNoScript) {
  const auto reading = StraightDrive();
  const ReportedDrive drive = Reported(reading, "a.mcap");
  std::string page = ReportPage(Spec(), {&drive, 1});
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  page = std::regex_replace(page, std::regex("xmlns='http://www.w3.org/2000/svg'"), "");
  for (const char* part : {"http:", "https:", "<script", "<link", "<img", "<iframe", "@import", "url(", "src="})
    EXPECT_THAT(page, Not(HasSubstr(part)));
}

TEST(ReportPage, NamesFromTheRecordingAreText) {
  const std::string hostile = "</svg></title><script>alert('x')</script>\" onload=\"y\n&";
  auto reading = StraightDrive();
  reading.events.push_back({measures::DriveEvent::Kind::kMark, 2.0, hostile, hostile});
  ReportedDrive drive = Reported(reading, hostile);
  drive.facts.subject = drive.facts.notes = drive.facts.version = hostile;
  drive.meta = {{hostile, hostile}, {"participant", hostile}};
  drive.rows[0].interval.name = hostile;
  const std::string page = ReportPage(Spec(), {&drive, 1});
  EXPECT_EQ(Count(page, "<script"), 0u);
  EXPECT_FALSE(std::regex_search(page, std::regex("<[^<>]*onload=\""))) << "within a tag";
  EXPECT_EQ(Count(page, "<svg"), Count(page, "</svg>"));
  EXPECT_EQ(Count(page, "</title>"), 1u);
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&quot; onload=&quot;y &amp;"));
}

TEST(ReportPage, RecordingsStandSideBySide) {
  const auto first = StraightDrive(), second = StraightDrive();
  std::vector<ReportedDrive> drives{Reported(first, "a.mcap"), Reported(second, "b.mcap")};
  drives[0].meta = {{"condition", "dry"}};
  drives[1].meta = {{"condition", "rain"}};
  const std::string page = ReportPage(Spec(), drives);
  EXPECT_THAT(page, HasSubstr("2 recordings"));
  EXPECT_EQ(Count(page, "<td class=\"number\">20</td>"), 2u);
  EXPECT_EQ(Count(StripsSvg(drives), ">rain</text>"), 2u) << "in the keys of speed and accelerator, which have values";
}

// A gap in the recording is a gap of its curves and of the way.
TEST(ReportPage, MissingSamplesInterruptCurvesAndWay) {
  const auto reading = StraightDrive();
  const ReportedDrive drive = Reported(reading, "a.mcap");
  EXPECT_EQ(Count(StripsSvg({&drive, 1}), "<polyline"), 4u) << "two quantities, two parts each";
  EXPECT_EQ(Count(MapSvg(reading.drive, nullptr), "<polyline"), 2u);
}

// A quantity that begins late stands on the time axis of the others.
// No table is wider than a sheet of paper, and each interval stands in one of them.
TEST(ReportPage, ManyIntervalsAreSeveralTables) {
  const auto reading = StraightDrive();
  ReportedDrive drive = Reported(reading, "a.mcap");
  const measures::MeasuresRow row = drive.rows[0];
  for (int i = 1; i < 14; ++i) {
    drive.rows.push_back(row);
    drive.rows.back().interval.name = "part" + std::to_string(i);
  }
  const std::string page = ReportPage(Spec(), {&drive, 1});
  const std::size_t measures = page.find("<h2>Measures</h2>");
  ASSERT_NE(measures, std::string::npos);
  int tables = 0;
  std::size_t headings = 0;
  for (auto at = page.find("<thead>", measures); at != std::string::npos; at = page.find("<thead>", at + 1), ++tables) {
    const std::size_t columns = Count(page.substr(at, page.find("</thead>", at) - at), "<th>");
    EXPECT_LE(columns, 8u);
    headings += columns - 2;
  }
  EXPECT_EQ(tables, 3);
  EXPECT_EQ(headings, 14u);
  for (int i = 1; i < 14; ++i) EXPECT_EQ(Count(page, "part" + std::to_string(i) + "<br>"), 1u);
}

TEST(ReportPage, AllStripsHaveTheRecordingsTime) {
  auto reading = StraightDrive();
  for (std::size_t k = 900; k < 1000; ++k) reading.drive.brake[k] = 0.1;
  const ReportedDrive drive = Reported(reading, "a.mcap");
  const std::string svg = StripsSvg({&drive, 1});
  EXPECT_EQ(Count(svg, ">time in s</text>"), 3u) << "speed, accelerator, brake";
  EXPECT_EQ(Count(svg, "text-anchor='middle'>4</text>"), 3u) << "a tick at 4 s under each";
}

TEST(ReportPage, ARecordingWithoutAnyPlaceHasNoMap) {
  auto reading = StraightDrive();
  std::fill(reading.drive.x_m.begin(), reading.drive.x_m.end(), kMissing);
  EXPECT_EQ(MapSvg(reading.drive, nullptr), "");
  const ReportedDrive drive = Reported(reading, "a.mcap");
  EXPECT_THAT(ReportPage(Spec(), {&drive, 1}), Not(HasSubstr("Way of")));
}

}  // namespace
}  // namespace rodeira::report
